// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/types.h"

#include <array>

namespace enfilade {

std::span<const std::string_view> EnumNames(ScaleSource) {
  static constexpr std::array<std::string_view, 4> kNames = {"poses", "camera_height",
                                                             "known_distance", "assumed"};
  return kNames;
}

std::span<const std::string_view> EnumNames(PoseSource) {
  static constexpr std::array<std::string_view, 5> kNames = {"transforms", "colmap", "csv", "zind",
                                                             "estimated"};
  return kNames;
}

}  // namespace enfilade
