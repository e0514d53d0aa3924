// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "enfilade/evaluate/judged_plan.h"

namespace enfilade {

/// Shares of walls, by count, whose true offset lies within one and two of their standard
/// deviations; none where there is no wall to judge.
struct Coverage {
  int num_walls = 0;
  std::optional<double> sigma1, sigma2;
};

struct CoverageFigures {
  Coverage all, seen, partly, inferred;
};

/// Judges the standard deviations that the plan gives for its walls.
///
/// How far a wall is off is the median over its length, doors and openings left out, of the
/// distance to the nearest true wall whose direction is within 30° (WallDistances); infinite where
/// there is none. Left out are walls without a standard deviation and walls that openings take up.
[[nodiscard]] CoverageFigures EvaluateCoverage(const Floorplan& floorplan, const JudgedPlan& truth);

}  // namespace enfilade
