// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/types.h"

#include <array>

namespace enfilade {

std::span<const std::string_view> EnumNames(EvidenceMode) {
  static constexpr std::array<std::string_view, 2> kNames{"log_odds", "counts"};
  return kNames;
}

}  // namespace enfilade
