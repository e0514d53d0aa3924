// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace enfilade {

/// What is known of the room about one panorama: its walls all round as seen from the camera, with
/// ordinary doors taken for closed, its floor and its ceiling. World frame (z up), metres.
struct RoomOutline {
  double floor_z = 0;
  double ceiling_z = 0;
  /// Azimuth of column 0; column c looks along it + 2πc/n, counter-clockwise.
  double first_azimuth_rad = 0;
  std::vector<float> wall_m;  ///< n horizontal distances from the camera

  /// Distance of the wall in a level direction of any length.
  [[nodiscard]] double WallDistance(const Eigen::Vector2d& direction) const;
  /// Distance along a unit ray from a camera at height `camera_z` to wall, floor or ceiling,
  /// whichever comes first.
  [[nodiscard]] double SurfaceDistance(double camera_z, const Eigen::Vector3d& ray) const;
};

}  // namespace enfilade
