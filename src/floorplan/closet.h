// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/geometry/boolean.h"

namespace enfilade {

/// Space as thin as this is a wall.
inline constexpr double kThickestWall_m = 0.35;
/// A closet that one can step into; shallower space is a cupboard of the room that it opens to.
inline constexpr double kClosetDepth_m = 0.7, kClosetArea_m2 = 0.8;

/// What of a region is width_m wide, with corners as they were.
[[nodiscard]] inline MultiPolygon2 OpenSharp(const MultiPolygon2& region, double width_m) {
  return OffsetSharp(OffsetSharp(region, -0.5 * width_m), 0.5 * width_m);
}

}  // namespace enfilade
