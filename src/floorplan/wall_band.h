// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "src/floorplan/loop_field.h"

namespace enfilade {

/// Of a wall's length: where evidence covers less, nobody saw a wall.
inline constexpr double kPartlySeenShare = 0.25;

/// Wall evidence beside a segment, as a function of the offset to its left.
struct WallBand {
  bool has_peak = false;
  double offset_m = 0;    ///< of the evidence's peak, positive to the left
  double seen_share = 0;  ///< share of the segment's length with evidence at the segment itself
};

/// Looks up to reach_m to either side of the segment a → b, which has the room on its left. The
/// peak is the mean over the segment of the faces' log-odds, that is their log-likelihood.
[[nodiscard]] WallBand MeasureWallBand(const LoopField& field, const Eigen::Vector2d& a,
                                       const Eigen::Vector2d& b, double reach_m);

}  // namespace enfilade
