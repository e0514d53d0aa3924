// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {

/// Radius of the disc that closes walls between rooms, and the size below which enclosed holes
/// are filled: the gross region.
inline constexpr double kGrossClosingRadius_m = 0.3;
inline constexpr double kGrossMaxHole_m2 = 1.0;

/// Union of the rooms' interiors: no wall bodies.
[[nodiscard]] MultiPolygon2 NetRegion(const JudgedPlan& plan);

/// The net region of the truth in another frame, which differs by a turn about z and a shift.
[[nodiscard]] MultiPolygon2 TrueRegion(const GroundTruth& truth, const Rigid3& frame_from_truth);

/// The net region with the walls inside it: closed with a disc, small enclosed holes filled.
[[nodiscard]] MultiPolygon2 GrossRegion(const MultiPolygon2& net);

struct RegionFigures {
  double area_net_m2 = 0, area_gross_m2 = 0;  ///< of the result
  double truth_area_net_m2 = 0, truth_area_gross_m2 = 0;
  double iou_net = 0, iou_gross = 0;
  /// (over + under) / truth on gross regions, the measure of Cabral and Furukawa (2014).
  double error_gross = 0;
};

/// Requires that the truth has an area.
[[nodiscard]] RegionFigures EvaluateRegions(const JudgedPlan& result, const JudgedPlan& truth);

}  // namespace enfilade
