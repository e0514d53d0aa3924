// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/structure/height_scores.h"

#include <algorithm>
#include <utility>

namespace enfilade {
namespace {

// What a height loses for a squared standard deviation from its prior, mean response; no more than
// for ten of them.
constexpr double kPriorWeight = 0.01;

}  // namespace

ColumnScores FloorLineScores(const HeightView& view, double floor_z, const Baseboard& baseboard,
                             const DistanceBins& bins) {
  if (!view.use_floor) return {};
  return ScoreFloor(*view.response, view.position.z() - floor_z, baseboard, bins);
}

WallPath BestPath(const ColumnScores& scores, const DistanceBins& bins,
                  const PlaneViterbiOptions& viterbi) {
  WallPath path = FindWallPath(scores, bins, viterbi, false);
  path.score /= 360.0;
  return path;
}

double PriorLoss(double height_m, double mean_m, double sigma_m) {
  const double off = (height_m - mean_m) / sigma_m;
  return kPriorWeight * std::min(off * off, 100.0);
}

size_t ArgMax(const std::vector<double>& values) {
  return static_cast<size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

double PeakPosition(const std::vector<double>& curve, const std::vector<double>& x) {
  const size_t i = ArgMax(curve);
  if (i == 0 || i + 1 == curve.size()) return x[i];
  const double curvature = curve[i - 1] - 2 * curve[i] + curve[i + 1];
  if (curvature >= 0) return x[i];
  return x[i] +
         (x[i + 1] - x[i]) * std::clamp(0.5 * (curve[i - 1] - curve[i + 1]) / curvature, -0.5, 0.5);
}

}  // namespace enfilade
