// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// A straight line through a room, from wall to wall, at which it is narrow.
struct Neck {
  Eigen::Vector2d a, b;  ///< what lies beyond is on the left of a → b
  Polygon2 near;         ///< cameras stand here
  Polygon2 beyond;       ///< nobody stands here; its outer ring begins with a, b
  /// Whether the wall on this side of the neck goes on straight beside it.
  bool is_near_straight = false, is_beyond_straight = false;

  [[nodiscard]] double Length() const { return (b - a).norm(); }
};

/// The edges of what lies beyond, without the neck.
[[nodiscard]] std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> WallsBeyond(
    const Neck& neck);

/// The necks of a room up to max_length_m long, with at least min_area_m2 on either side, beyond
/// which no camera stands while one stands before them. Walls must jut at a neck: its ends are two
/// corners that point into the room, or it prolongs a wall that ends in two such corners. So the
/// arm of an L hangs on no neck. Cost O(n²) for n corners, and O(n) for each pair of near ones.
[[nodiscard]] std::vector<Neck> FindNecks(const Polygon2& room,
                                          const std::vector<Eigen::Vector2d>& cameras,
                                          double max_length_m, double min_area_m2);

}  // namespace enfilade
