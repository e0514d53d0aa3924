// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/room_outline.h"

namespace enfilade {

/// The outline of a box room from `low` to `high` as a camera in it sees it; the floor is z = 0.
inline RoomOutline BoxOutline(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                              const Eigen::Vector2d& camera, double ceiling_z) {
  constexpr int kNumColumns = 1024;
  RoomOutline outline;
  outline.ceiling_z = ceiling_z;
  outline.first_azimuth_rad = -kPi;
  for (int c = 0; c < kNumColumns; ++c) {
    const double azimuth = outline.first_azimuth_rad + 2 * kPi * c / kNumColumns;
    const double x = std::cos(azimuth), y = std::sin(azimuth);
    const double to_x = std::abs(x) < 1e-9 ? 1e9 : ((x > 0 ? high : low).x() - camera.x()) / x;
    const double to_y = std::abs(y) < 1e-9 ? 1e9 : ((y > 0 ? high : low).y() - camera.y()) / y;
    outline.wall_m.push_back(static_cast<float>(std::min(to_x, to_y)));
  }
  return outline;
}

}  // namespace enfilade
