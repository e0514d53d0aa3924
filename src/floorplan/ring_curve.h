// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// Where a simpler ring leaves one wall's line for that of a later wall, without those between.
struct RingCorner {
  size_t from = 0, to = 0;  ///< edges of the ring
  Eigen::Vector2d at;       ///< where the two lines meet
  /// Closed walk from `from`'s end over the walls left out to `to`'s start and back over `at`,
  /// reversed: what the corner adds to the ring's inside lies on its left, what it takes away on
  /// its right.
  Ring2 change;
};

/// What such a corner costs, at least 0; nothing where it must not be.
using CornerPrice = std::function<std::optional<double>(const RingCorner&)>;

/// A ring with fewer walls, each on the line of one wall of the ring that it came from.
struct SimplerRing {
  double cost = 0;
  Ring2 ring;
  std::vector<size_t> wall_idx;  ///< for each of its edges the edge of the first ring
};

/// For every number of walls the cheapest simple ring whose walls lie on the lines of walls of
/// `ring`, in the same order and with the same direction, each with at least a part of the wall
/// that it comes from. Cost: the sum over the corners that the ring did not have; walls between
/// which the ring itself has a corner meet there for nothing. So the ring itself costs 0.
///
/// Returns them in ascending order of their numbers of walls, those that cost less than all with
/// fewer walls; the last is `ring`. At most kMaxLeftOut walls are left out in a row. Exact, by
/// dynamic programming over corners and numbers of walls, and by branching on corners where the
/// cheapest ring would cross or touch itself; a number for which that takes more than kMaxBranches
/// solves has no ring. Requires a simple ring. Ties are broken the same way on every run. Cost: O(C
/// · c · n · w) for C corners that may be, c of them on a wall, w over one end of the ring, n
/// walls.
[[nodiscard]] std::vector<SimplerRing> FindSimplerRings(const Ring2& ring,
                                                        const CornerPrice& price);

inline constexpr size_t kMaxLeftOut = 24;
inline constexpr int kMaxBranches = 64;

}  // namespace enfilade
