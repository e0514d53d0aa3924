// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/wall_sight.h"

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

// A panorama sees a point that lies no farther than its wall in that direction, with this slack.
constexpr double kVisibilitySlack = 1.12;
constexpr double kVisibilitySlack_m = 0.15;

}  // namespace

int ColumnOf(const Eigen::Vector2d& ray, int num_columns) {
  const double turn = std::atan2(ray.y(), ray.x()) / (2 * kPi) + 0.5;
  return std::clamp(static_cast<int>(turn * num_columns), 0, num_columns - 1);
}

double DistanceTowards(const KnownDistances& known, const Eigen::Vector2d& ray) {
  return known[static_cast<size_t>(ColumnOf(ray, static_cast<int>(known.size())))];
}

std::vector<int> NearestOthers(std::span<const Eigen::Vector2d> positions, size_t self) {
  std::vector<int> others;
  for (size_t j = 0; j < positions.size(); ++j) {
    if (j != self) others.push_back(static_cast<int>(j));
  }
  const auto distance = [&](int j) {
    return (positions[static_cast<size_t>(j)] - positions[self]).norm();
  };
  std::stable_sort(others.begin(), others.end(),
                   [&](int a, int b) { return distance(a) < distance(b); });
  return others;
}

bool WouldSee(const WallPoint& wall, const Eigen::Vector2d& position, const KnownDistances& known,
              double max_range_m) {
  const Eigen::Vector2d ray = wall.point - position;
  const double range = ray.norm();
  if (range > max_range_m) return false;
  const double side = -wall.normal.dot(ray);
  const double own_side = wall.normal.dot(wall.seen_from - wall.point);
  if (side * own_side <= 0 || std::abs(side) < kMinIncidenceSin * range) return false;
  if (known.empty()) return true;
  return range <= kVisibilitySlack * DistanceTowards(known, ray) + kVisibilitySlack_m;
}

}  // namespace enfilade
