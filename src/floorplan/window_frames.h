// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "src/floorplan/facade.h"

namespace enfilade {

/// A rectangle of edges on a wall that light comes through.
struct WindowFrame {
  double begin_m = 0, end_m = 0;  ///< along the wall
  double sill_m = 0, head_m = 0;  ///< above the floor
  float strength = 0;             ///< 0–4: how clear its four sides are
  float brightness = 0;           ///< inside less beside it, grey levels
};

/// The clearest rectangles of a wall at least 0.5 m wide and high, the sill 0.25 m or more above
/// the floor, that are much brighter than the wall beside them; clearest first, none over another.
/// Cost: O(sills · heads · (columns + edges²)).
[[nodiscard]] std::vector<WindowFrame> FindWindowFrames(const Facade& facade, float min_strength);

}  // namespace enfilade
