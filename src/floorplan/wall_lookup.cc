// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/wall_lookup.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr double kTolerance_m = 0.01;

// Length of the part of the wall that lies on the edge, 0 when the wall leaves the edge's line.
double CommonLength(const Wall& wall, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double length = (b - a).norm();
  if (length == 0) return 0;
  const Eigen::Vector2d along = (b - a) / length;
  const Eigen::Vector2d normal(-along.y(), along.x());
  if (std::abs(normal.dot(wall.a - a)) > kTolerance_m ||
      std::abs(normal.dot(wall.b - a)) > kTolerance_m) {
    return 0;
  }
  const double begin = along.dot(wall.a - a), end = along.dot(wall.b - a);
  return std::min(std::max(begin, end), length) - std::max(std::min(begin, end), 0.0);
}

}  // namespace

const Wall* FindWallOfEdge(const Storey& storey, int room_id, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Wall* best = nullptr;
  double best_length = kTolerance_m;
  for (const Wall& wall : storey.walls) {
    if (wall.room_id != room_id) continue;
    const double length = CommonLength(wall, a, b);
    if (length > best_length) {
      best = &wall;
      best_length = length;
    }
  }
  return best;
}

}  // namespace enfilade
