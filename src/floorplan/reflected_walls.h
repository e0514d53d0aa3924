// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/floorplan/loop_field.h"
#include "src/floorplan/necks.h"

namespace enfilade {

/// The seen walls beyond a neck, in metres, and those of them that stand where the room before it
/// has a wall if it is reflected across the neck.
struct ReflectedWalls {
  double seen_m = 0, repeated_m = 0;
  double facing_seen_m = 0, facing_repeated_m = 0;  ///< those that face the neck

  /// Whether the neck is a mirror: most walls are repeated, also most of those that face it. Side
  /// walls alone are no sign, for a closet's may lie in line with the room's.
  [[nodiscard]] bool IsMirror() const;
};

[[nodiscard]] ReflectedWalls CompareWithReflection(const LoopField& field, const Neck& neck);

}  // namespace enfilade
