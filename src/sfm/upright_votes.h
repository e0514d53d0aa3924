// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/two_view.h"

namespace enfilade {

/// A match as unit rays of a and b in their level frames, and how much it counts.
struct UprightVote {
  Eigen::Vector3d a, b;
  double weight = 1;
};

/// Yaws of b in a's frame to be tried, a whole turn by default.
struct YawRange {
  double center_rad = 0;
  double reach_rad = kPi;
};

/// Candidates for the relative pose of two level panoramas whose baseline is level: the best local
/// maxima of the votes over yaw and direction, best first. For each yaw the plane of two matched
/// rays meets the horizon in one line, on which the baseline must lie; which way it points follows
/// from both rays meeting in front.
[[nodiscard]] std::vector<TwoViewGeometry> VoteUpright(std::span<const UprightVote> matches,
                                                       const YawRange& yaws = {});

}  // namespace enfilade
