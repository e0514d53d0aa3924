// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/evidence/grid.h"

namespace enfilade {

/// What one column of one panorama says about the wall in its direction. `structure` produces
/// these.
struct WallSample {
  int view_idx = 0;
  Eigen::Vector2d origin{0, 0};     ///< camera in the home plan, metres
  Eigen::Vector2d direction{1, 0};  ///< unit, horizontal, home frame
  double spread_rad = 0;            ///< angular width of the column
  double wall_m = 0;                ///< most likely distance of the structural wall
  double obstacle_m = 0;            ///< most likely distance of the first obstacle, ≤ wall_m
  double confidence = 0;            ///< 0–1: how sharply the wall's distance is known
  /// P(wall in bin i) over the bins of WallSampleSet; sums to one. Empty when the column saw
  /// nothing.
  std::vector<float> wall_probability;
};

/// Samples that share their distance bins.
struct WallSampleSet {
  std::vector<double> bin_m;  ///< ascending centres of the distance bins
  std::vector<WallSample> samples;
};

/// The evidence of one storey. All images have frame.rows × frame.cols pixels.
struct EvidenceGrids {
  GridFrame frame;
  ImageF wall;   ///< log-odds that a wall face lies in the cell (raw mode: number of points)
  ImageF free;   ///< log-odds that the cell is free space (raw mode: number of rays)
  ImageU8 core;  ///< 0, or 1 + the index of the core component that the cell belongs to
  int num_cores = 0;
};

}  // namespace enfilade
