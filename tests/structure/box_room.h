// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "enfilade/structure/column_scores.h"
#include "enfilade/structure/level_panorama.h"
#include "enfilade/structure/line_response.h"

namespace enfilade {

/// An empty room of which every ray's colour is known: walls along x and y of a plan that is turned
/// by `heading_rad` about the frame's z axis. Colours are grey levels.
struct BoxRoom {
  Eigen::Vector2d min{0, 0}, max{4, 3};  ///< of the plan, before it is turned
  double floor_z = 0;
  double ceiling_z = 2.5;
  double baseboard_m = 0;
  double heading_rad = 0;
  double floor_grey = 90;
  double baseboard_grey = 235;
  double wall_grey = 190;
  double wall_shading = 12;  ///< how much the walls of different direction differ
  double wall_slope = 0;     ///< change of grey along the walls, a metre
  double wall_texture = 0;   ///< amplitude of a smooth pattern on the walls
  double ceiling_grey = 225;

  /// What is seen from `position` along `ray`.
  [[nodiscard]] double Grey(const Eigen::Vector3d& position, const Eigen::Vector3d& ray) const;
  /// Horizontal distance of the wall from `position` along an azimuth of the frame.
  [[nodiscard]] double WallDistance(const Eigen::Vector2d& position, double azimuth_rad) const;
  /// Family of that wall: 0 when it runs along the frame's x axis, 1 when along y. Heading 0 only.
  [[nodiscard]] int WallFamily(const Eigen::Vector2d& position, double azimuth_rad) const;
};

/// A panorama of `width` × width/2 pixels, each the mean of rays_per_side² rays, with
/// Gaussian noise of standard deviation `noise` grey levels; all of it seen.
[[nodiscard]] LevelPanorama DrawPanorama(const BoxRoom& room, const Eigen::Vector3d& position,
                                         int width, double noise = 0, int seed = 1,
                                         int rays_per_side = 3);

/// Distance of the wall in each column, and the family of its plane.
struct ColumnTruth {
  std::vector<double> wall_m;
  std::vector<int> family;
};
[[nodiscard]] ColumnTruth TruthOfColumns(const BoxRoom& room, const Eigen::Vector2d& position,
                                         int num_columns);

/// Responses as a perfect detector gives them, families 0 and 1: a ridge one row wide where the
/// picture shows the horizontal line of the wall at each height above the camera, in the family of
/// the wall.
[[nodiscard]] LineResponse PerfectResponse(const ColumnTruth& truth, int rows,
                                           const std::vector<double>& heights_m);

/// Scores that peak with `peak` at the true distance in the true family and fall to 0 over `reach`
/// bins; families 0 and 1.
[[nodiscard]] ColumnScores PerfectScores(const ColumnTruth& truth, const DistanceBins& bins,
                                         double peak = 1, double reach = 2);

}  // namespace enfilade
