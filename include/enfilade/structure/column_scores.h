// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/image/image.h"
#include "enfilade/structure/line_response.h"

namespace enfilade {

/// Logarithmic bins of horizontal distance: bin i is centred at min_m · exp(i · log_step).
struct DistanceBins {
  double min_m = 0.3;
  double log_step = 0.015;
  int count = 280;

  [[nodiscard]] double Distance(double bin) const { return min_m * std::exp(bin * log_step); }
  /// Continuous bin of a distance; may lie outside [0, count).
  [[nodiscard]] double Bin(double distance_m) const {
    return std::log(distance_m / min_m) / log_step;
  }
  [[nodiscard]] std::vector<double> Centers() const;
};

/// Evidence for a wall at each distance in each column, one picture a family of planes:
/// num_columns × bins.count (a row is a column of the panorama). Empty pictures: family not used.
struct ColumnScores {
  std::vector<ImageF> family = std::vector<ImageF>(kNumFamilies);
};

/// Response of the line at `height_m` below the camera (negative: above it) as a function of
/// distance.
[[nodiscard]] ColumnScores ScoreLine(const LineResponse& response, double height_m,
                                     const DistanceBins& bins);

/// Mean response of the floor line at `floor_m` below the camera and, when `baseboard_m` > 0, of
/// the upper edge of the baseboard: the edge between floor and wall is a double edge, and taking
/// the stronger one alone biases every distance.
[[nodiscard]] ColumnScores ScoreFloor(const LineResponse& response, double floor_m,
                                      double baseboard_m, const DistanceBins& bins);

struct ObstacleOptions {
  double min_gap_m = 0.25;
  double max_gap_m = 0.9;
  double cost = 0.6;

  void Visit(OptionVisitor& v) {
    v("min_gap_m", min_gap_m,
      "Least distance from the first obstacle to the wall behind it, metres.", {0.05, 2.0});
    v("max_gap_m", max_gap_m, "Largest such distance, metres.", {0.05, 5.0});
    v("cost", cost, "Response that the obstacle's floor line must gain over the wall's.",
      {0.0, 1.0});
  }
};

/// Lets something stand before the wall: the best floor score of the wall itself or, less a cost,
/// of an obstacle in front of it within the allowed gap.
[[nodiscard]] ColumnScores AllowObstacles(const ColumnScores& floor, const DistanceBins& bins,
                                          const ObstacleOptions& options);

/// target += weight · source. Families that `source` lacks are left; ones that `target` lacks begin
/// at zero.
void AddScores(const ColumnScores& source, double weight, ColumnScores& target);

}  // namespace enfilade
