// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// A plan by hand: rings of wall faces and the panoramas that look at them.
struct PlanToSample {
  std::vector<Ring2> rings;
  std::vector<Eigen::Vector2d> cameras;  ///< view_idx is the position in this list
  int num_columns = 512;
  int num_bins = 256;
  double sigma_m = 0.02;  ///< of each column's distribution
  /// Distance of the wall that a view claims; by default the nearest ring.
  std::function<double(int view_idx, const Eigen::Vector2d& direction)> distance;
};

[[nodiscard]] PlanToSample PlanFromText(std::string_view ring,
                                        std::vector<Eigen::Vector2d> cameras);

/// Log-spaced centres from 0.2 to 15 m.
[[nodiscard]] std::vector<double> LogBins(int num_bins);

/// Distance to the nearest ring, 15 m when there is none.
[[nodiscard]] double NearestWall(const std::vector<Ring2>& rings, const Eigen::Vector2d& origin,
                                 const Eigen::Vector2d& direction);

/// One sample a column: a Gaussian round the true distance.
[[nodiscard]] WallSampleSet SamplesOf(const PlanToSample& plan);

/// The value of the cell at (x, y).
template <typename T>
[[nodiscard]] T At(const EvidenceGrids& grids, const Image<T>& image, double x, double y) {
  return image(grids.frame.Row(y), grids.frame.Col(x));
}

}  // namespace enfilade
