// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/evidence/types.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// Wall evidence beside a segment, as a function of the offset to its left.
struct WallBand {
  double offset_m = 0;    ///< of the evidence's peak, positive to the left
  double sigma_m = 0;     ///< width of the peak
  double seen_share = 0;  ///< share of the segment's length with evidence at the segment itself
  bool has_peak = false;
};

/// Looks up to reach_m to either side of the segment a → b, which has the room on its left.
[[nodiscard]] WallBand MeasureWallBand(const LoopField& field, const Eigen::Vector2d& a,
                                       const Eigen::Vector2d& b, double reach_m);

/// Moves every edge of an axis-parallel polygon along its normal onto the wall evidence, unless
/// that would break the polygon. Returns the number of edges moved.
int SlideToEvidence(const LoopField& field, double reach_m, Polygon2& polygon);

}  // namespace enfilade
