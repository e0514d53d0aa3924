// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/structure/column_scores.h"

namespace enfilade {

struct PlaneViterbiOptions {
  double corner_cost_deg = 4.5;
  double jump_cost_deg = 10.0;
  double diagonal_cost = 0.04;
  double frontal_cost = 0.20;
  double frontal_step_cost = 0.1;
  double temperature_deg = 2.0;

  void Visit(OptionVisitor& v) {
    v("corner_cost_deg", corner_cost_deg,
      "Cost of a corner where two walls meet, in degrees of azimuth at full response.",
      {0.0, 360.0});
    v("jump_cost_deg", jump_cost_deg,
      "Cost of a jump in depth, where a wall hides what is behind it.", {0.0, 360.0});
    v("diagonal_cost", diagonal_cost, "Response that a wall at 45 degrees must gain.", {0.0, 10.0});
    v("frontal_cost", frontal_cost, "Response that a wall of free direction must gain.",
      {0.0, 10.0});
    v("frontal_step_cost", frontal_step_cost,
      "Cost, in degrees, of each step of one bin of a wall of free direction.", {0.0, 10.0});
    v("temperature_deg", temperature_deg,
      "Score difference, in degrees at full response, that counts as one nat of likelihood.",
      {0.01, 100.0});
  }
};

/// The best walls all round a panorama.
struct WallPath {
  std::vector<int> family;     ///< of the plane in each column
  std::vector<double> wall_m;  ///< distance in each column
  double score = 0;            ///< total, in degrees at full response
  /// num_columns × bins.count: log-likelihood of the wall lying in a bin, up to a constant per row:
  /// the best path through it, less the best path (max-marginal), divided by the temperature.
  ImageF log_likelihood;
};

/// Explains the columns by planes: a circular Viterbi over states (family, offset of the plane).
///
/// A vertical wall of a known direction at offset d has distance d/|cos(azimuth − normal)|, so
/// along a wall the state is constant and its score is read from scores.family at a moving bin.
/// Changing to a plane of another family at the same distance costs a corner, any other change a
/// jump. The frontal family follows free forms at a cost per column and step. After Flint, Mei,
/// Murray & Reid (ECCV 2010), in polar form.
///
/// The circle is closed exactly for the state of the most certain column; max-marginals come from
/// two laps in each direction. Cost O(num_columns × families² × bins). The score of
/// `with_likelihood` false leaves log_likelihood empty and saves the backward laps.
[[nodiscard]] WallPath FindWallPath(const ColumnScores& scores, const DistanceBins& bins,
                                    const PlaneViterbiOptions& options, bool with_likelihood);

}  // namespace enfilade
