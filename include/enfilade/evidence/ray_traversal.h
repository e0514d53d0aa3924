// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "enfilade/base/check.h"
#include "enfilade/evidence/grid.h"

namespace enfilade {

/// Calls `visit(row, col)` for every cell of the grid that the segment from `a` to `b` crosses,
/// once each, in order from `a`; parts outside the grid are passed over in silence. Where the
/// segment runs exactly through a corner, the cell beside the corner in x is visited too.
///
/// `visit` returns false to stop. Both ends must be finite. Cost: the number of cells crossed,
/// inside and outside. Amanatides & Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing" (1987).
template <typename Visit>
void TraverseCells(const GridFrame& frame, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                   Visit&& visit) {
  ENFILADE_CHECK(a.allFinite() && b.allFinite());
  const Eigen::Vector2d start = (a - frame.origin) / frame.cell_m;
  const Eigen::Vector2d span = (b - a) / frame.cell_m;
  constexpr double kNever = std::numeric_limits<double>::infinity();

  int64_t cell[2], last[2];
  int step[2];
  double next[2], delta[2];  // parameter along the segment, 0 at a and 1 at b
  for (int k = 0; k < 2; ++k) {
    cell[k] = static_cast<int64_t>(std::floor(start[k]));
    last[k] = static_cast<int64_t>(std::floor(start[k] + span[k]));
    step[k] = span[k] < 0 ? -1 : 1;
    const double to_border = span[k] < 0 ? start[k] - static_cast<double>(cell[k])
                                         : static_cast<double>(cell[k]) + 1 - start[k];
    delta[k] = span[k] == 0 ? kNever : 1 / std::abs(span[k]);
    next[k] = span[k] == 0 ? kNever : to_border * delta[k];
  }
  // Counting the steps, not comparing parameters with 1, ends exactly in the cell of b.
  int64_t steps_left[2] = {std::abs(last[0] - cell[0]), std::abs(last[1] - cell[1])};
  for (;;) {
    const bool inside =
        cell[0] >= 0 && cell[1] >= 0 && cell[0] < frame.cols && cell[1] < frame.rows;
    if (inside && !visit(static_cast<int>(cell[1]), static_cast<int>(cell[0]))) return;
    if (steps_left[0] == 0 && steps_left[1] == 0) return;
    const bool along_x = steps_left[1] == 0 || (steps_left[0] > 0 && next[0] <= next[1]);
    const int k = along_x ? 0 : 1;
    cell[k] += step[k];
    next[k] += delta[k];
    --steps_left[k];
  }
}

}  // namespace enfilade
