// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/surface_report.h"

#include <array>

namespace enfilade {

std::span<const std::string_view> EnumNames(SurfaceOutcome) {
  static constexpr std::array<std::string_view, 2> kNames = {"found", "no_surface"};
  return kNames;
}

}  // namespace enfilade
