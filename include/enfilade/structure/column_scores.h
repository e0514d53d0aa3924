// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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
  /// The bin of a distance, the first or last one beyond their ends.
  [[nodiscard]] int NearestBin(double distance_m) const {
    return std::clamp(static_cast<int>(std::lround(Bin(distance_m))), 0, count - 1);
  }
  [[nodiscard]] std::vector<double> Centers() const;
};

/// Evidence for a wall at each distance in each column, one picture a family of planes:
/// num_columns × bins.count (a row is a column of the panorama). Empty pictures: family not used.
struct ColumnScores {
  std::vector<ImageF> family = std::vector<ImageF>(kNumFamilies);
};

/// Response of the line at `height_m` below the camera (negative: above it) and `before_m` in front
/// of the wall as a function of the wall's distance.
[[nodiscard]] ColumnScores ScoreLine(const LineResponse& response, double height_m,
                                     const DistanceBins& bins, double before_m = 0);

/// The strongest score within `reach` bins to either side: for lines at a height that is not known
/// exactly.
[[nodiscard]] ColumnScores WidenScores(const ColumnScores& scores, int reach);

/// The second line between floor and wall: the upper edge of the baseboards.
struct Baseboard {
  double height_m = 0;  ///< above the floor; 0 for none
  double share = 0.5;   ///< 0–1: what the upper edge has of both lines' response
};

/// Response of the floor line at `floor_m` below the camera and of the upper edge of the baseboard,
/// each by its share: the edge between floor and wall is a double edge, and taking the stronger one
/// for the floor biases every distance.
[[nodiscard]] ColumnScores ScoreFloor(const LineResponse& response, double floor_m,
                                      const Baseboard& baseboard, const DistanceBins& bins);

/// Response of the ceiling line at `above_m` above the camera. Where a cornice of `cornice_m` runs
/// between wall and ceiling (0: none), the mean of its two edges: the upper one on the ceiling,
/// before the wall, the lower one on the wall, below the ceiling.
[[nodiscard]] ColumnScores ScoreCeiling(const LineResponse& response, double above_m,
                                        double cornice_m, const DistanceBins& bins);

struct FloorEndOptions {
  double weight = 0.8;
  double reach_m = 1.2;

  void Visit(OptionVisitor& v) {
    v("weight", weight, "Share of its score that a line loses when the floor goes on behind it.",
      {0.0, 1.0});
    v("reach_m", reach_m, "How far behind a line it is looked whether the floor goes on, metres.",
      {0.0, 10.0});
  }
};

/// Takes floor lines for what they are worth when the floor goes on behind them: joints between
/// tiles, edges of rugs, thresholds. Lines that run across the hypothesised wall (of families 0 and
/// 1) cannot lie on it, as a wall shows level lines along it and upright ones; where such a line
/// shows within `reach_m` behind the wall's foot, more clearly than one along the wall, up to
/// `weight` of the score is lost. Orientation maps (Lee, Hebert & Kanade, CVPR 2009) reason
/// likewise. `floor` are the responses of floor lines of a camera `floor_m` above the floor. Cost
/// O(columns × bins × bins within reach_m).
[[nodiscard]] ColumnScores StopFloorLines(const ColumnScores& floor, double floor_m,
                                          const DistanceBins& bins, const FloorEndOptions& options);

struct CeilingEndOptions {
  double weight = 1;
  double reach_m = 2.5;
  double before_m = 0.7;

  void Visit(OptionVisitor& v) {
    v("weight", weight, "Share of its score that a wall loses when the ceiling goes on behind it.",
      {0.0, 1.0});
    v("reach_m", reach_m, "How far behind a wall it is looked whether the ceiling goes on, metres.",
      {0.0, 10.0});
    v("before_m", before_m,
      "What hides the wall's end of the ceiling hangs no farther before it, metres.", {0.0, 10.0});
  }
};

/// What a wall at each distance keeps of its score (columns × bins, 0–1) where the ceiling shows to
/// go on behind it, as above a bed or a sofa: a wall ends the ceiling. Lost is `weight` times
/// what the strongest ceiling line (of families 0 and 1) within `reach_m` behind the wall exceeds
/// the strongest (of any family) at it and up to `before_m` before it. Where the ceiling's line
/// lies before the wall, as that of a bulkhead, the lines behind it are not on the ceiling and
/// nothing is lost. `ceiling` are the responses of ceiling lines. Cost O(columns × bins × bins
/// within reach_m).
[[nodiscard]] ImageF CeilingEnds(const ColumnScores& ceiling, const DistanceBins& bins,
                                 const CeilingEndOptions& options);

struct ObstacleOptions {
  double min_gap_m = 0.25;
  double max_gap_m = 0.9;
  double cost = 0.45;

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

/// What speaks for a wall, times `share` (columns × bins); what speaks against it stays.
void ScaleScores(const ImageF& share, ColumnScores& scores);

/// target += weight · source. Families that `source` lacks are left; ones that `target` lacks begin
/// at zero.
void AddScores(const ColumnScores& source, double weight, ColumnScores& target);

}  // namespace enfilade
