// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/walls.h"

#include <algorithm>
#include <limits>

#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double DistanceToAny(const Vector2d& p, const std::vector<const Segment2*>& segments) {
  double nearest = kInfinity;
  for (const Segment2* segment : segments) {
    nearest = std::min(nearest, DistanceToSegment(p, (*segment)[0], (*segment)[1]));
  }
  return nearest;
}

}  // namespace

std::vector<double> WallDistances(const std::vector<Segment2>& from,
                                  const std::vector<Segment2>& to) {
  std::vector<double> distances;
  double to_next_sample =
      0.5 * kWallSample_m;  // carried over the ends, so that short walls count too
  for (const Segment2& wall : from) {
    std::vector<const Segment2*> parallel;
    for (const Segment2& other : to) {
      if (AreParallelWalls(wall, other)) parallel.push_back(&other);
    }
    const double length = (wall[1] - wall[0]).norm();
    const Vector2d direction = (wall[1] - wall[0]) / length;
    double at = to_next_sample;
    for (; at < length; at += kWallSample_m) {
      distances.push_back(DistanceToAny(wall[0] + at * direction, parallel));
    }
    to_next_sample = at - length;
  }
  return distances;
}

WallFigures EvaluateWalls(const JudgedPlan& result, const JudgedPlan& truth) {
  WallFigures figures;
  if (result.walls.empty() || truth.walls.empty()) return figures;
  const std::vector<double> plan_to_truth = WallDistances(result.walls, truth.walls);
  const std::vector<double> truth_to_plan = WallDistances(truth.walls, result.walls);
  if (plan_to_truth.empty() || truth_to_plan.empty()) return figures;
  figures.plan_to_truth_median_m = Median(plan_to_truth);
  figures.plan_to_truth_p95_m = Quantile(plan_to_truth, 0.95);
  figures.truth_to_plan_median_m = Median(truth_to_plan);
  figures.truth_to_plan_p95_m = Quantile(truth_to_plan, 0.95);
  const auto hits =
      std::count_if(truth_to_plan.begin(), truth_to_plan.end(), [](double d) { return d <= 0.10; });
  figures.within_10cm = static_cast<double>(hits) / static_cast<double>(truth_to_plan.size());
  return figures;
}

}  // namespace enfilade
