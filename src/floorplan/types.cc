// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/types.h"

namespace enfilade {

int OutlineChoice::NumVertices() const {
  size_t num_vertices = polygon.outer.size();
  for (const Ring2& hole : polygon.holes) num_vertices += hole.size();
  return static_cast<int>(num_vertices);
}

std::span<const std::string_view> EnumNames(WallSeen) {
  static constexpr std::array<std::string_view, 3> kNames = {"seen", "partly", "inferred"};
  return kNames;
}

std::span<const std::string_view> EnumNames(OpeningKind) {
  static constexpr std::array<std::string_view, 3> kNames = {"door", "opening", "window"};
  return kNames;
}

}  // namespace enfilade
