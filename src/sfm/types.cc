// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/types.h"

#include <array>

namespace enfilade {

std::span<const std::string_view> EnumNames(PairVerdict) {
  static constexpr std::array<std::string_view, 6> kNames = {
      "accepted", "same place", "few matches", "chance", "against triplets", "against positions"};
  return kNames;
}

}  // namespace enfilade
