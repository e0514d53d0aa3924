// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/image/image.h"

namespace enfilade {

/// Wall distances all round one panorama, in the home frame.
///
/// Column c looks along the azimuth AzimuthOfColumn(c) = 2π(c + ½)/num_columns − π,
/// counter-clockwise from +x. Distances are horizontal, in metres from the camera.
struct WallProfile {
  int view_idx = 0;
  double floor_z = 0;             ///< of the floor under this panorama, home frame
  double ceiling_z = 0;           ///< of the ceiling above it
  double ceiling_weight = 1;      ///< 0–1: how much the ceiling is a level plane
  std::vector<float> wall_m;      ///< structural wall, most likely
  std::vector<float> obstacle_m;  ///< first obstacle, ≤ wall_m
  std::vector<float> confidence;  ///< 0–1: how well its lines explain the wall (WallConfidence)
  std::vector<uint8_t> is_seen;   ///< 0 where the picture does not cover the column (pinhole views)
  /// num_columns × num_bins: P(wall in bin) from the min-marginals; every row sums to one.
  ImageF wall_probability;

  [[nodiscard]] int num_columns() const { return static_cast<int>(wall_m.size()); }
};

/// What structure finds for one storey.
struct StoreyStructure {
  double floor_z = 0;
  double ceiling_z = 0;    ///< the most common one
  double baseboard_m = 0;  ///< height of the second floor line, 0 when there is none
};

/// Directions, heights and wall profiles of the whole home.
struct Structure {
  /// World turned about z so that the dominant walls run along x and y. Rotation only.
  Rigid3 home_from_world;
  double heading_rad = 0;  ///< of the home's x axis in the world, in [−π/4, π/4)
  std::vector<StoreyStructure> storeys;
  std::vector<double> bin_m;          ///< ascending centres of the distance bins
  std::vector<WallProfile> profiles;  ///< one a view, in the order of the views
};

[[nodiscard]] double AzimuthOfColumn(int column, int num_columns);

}  // namespace enfilade
