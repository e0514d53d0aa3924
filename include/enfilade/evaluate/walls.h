// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "enfilade/evaluate/judged_plan.h"

namespace enfilade {

/// Spacing of the samples along walls.
inline constexpr double kWallSample_m = 0.01;

/// Distances from samples along `from`, every kWallSample_m of its total length, to the nearest of
/// `to` whose direction is within 30°; infinite where there is none. No cap. Cost: samples × |to|.
[[nodiscard]] std::vector<double> WallDistances(const std::vector<Segment2>& from,
                                                const std::vector<Segment2>& to);

struct WallFigures {
  std::optional<double> plan_to_truth_median_m, plan_to_truth_p95_m;
  std::optional<double> truth_to_plan_median_m, truth_to_plan_p95_m;
  std::optional<double> within_10cm;  ///< share of the true wall length
};

/// None where a side has no walls, or where a quantile falls on walls without a parallel
/// counterpart.
[[nodiscard]] WallFigures EvaluateWalls(const JudgedPlan& result, const JudgedPlan& truth);

}  // namespace enfilade
