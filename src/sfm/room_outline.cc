// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/room_outline.h"

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {

double RoomOutline::WallDistance(const Eigen::Vector2d& direction) const {
  const double turns = (std::atan2(direction.y(), direction.x()) - first_azimuth_rad) / (2 * kPi);
  const auto num_columns = static_cast<double>(wall_m.size());
  const double column = std::round((turns - std::floor(turns)) * num_columns);
  return static_cast<double>(wall_m[static_cast<size_t>(column) % wall_m.size()]);
}

double RoomOutline::SurfaceDistance(double camera_z, const Eigen::Vector3d& ray) const {
  const double level = ray.head<2>().norm();
  constexpr double kLeast = 1e-9;
  double distance_m = WallDistance(ray.head<2>()) / std::max(level, kLeast);
  if (ray.z() < -kLeast) distance_m = std::min(distance_m, (floor_z - camera_z) / ray.z());
  if (ray.z() > kLeast) distance_m = std::min(distance_m, (ceiling_z - camera_z) / ray.z());
  return distance_m;
}

}  // namespace enfilade
