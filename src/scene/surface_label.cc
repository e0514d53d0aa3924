// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/surface_label.h"

#include <array>

namespace enfilade {

std::span<const std::string_view> EnumNames(SurfaceLabel) {
  static constexpr std::array<std::string_view, 4> kNames = {"other", "floor", "wall", "ceiling"};
  return kNames;
}

}  // namespace enfilade
