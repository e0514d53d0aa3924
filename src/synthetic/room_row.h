// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "src/synthetic/random.h"
#include "src/synthetic/rectangle.h"

namespace enfilade {

/// Of a wall between two rooms.
[[nodiscard]] inline double InnerThickness(Random& random) {
  return random.Millimetres(0.08, 0.20);
}

/// `count` rooms of one depth and different widths, from `low` to the right, that fill `length_m`
/// with the walls between them. None when one is narrower than 2.3 m.
[[nodiscard]] std::optional<std::vector<Rectangle>> DivideRow(const Eigen::Vector2d& low,
                                                              double length_m, double depth_m,
                                                              int count, Random& random);

}  // namespace enfilade
