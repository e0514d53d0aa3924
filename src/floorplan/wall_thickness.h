// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// How a face stands to another that looks the other way.
struct FarFace {
  double gap_m = 0;     ///< of its middle behind the other's line, negative before it
  double common_m = 0;  ///< of the other's length that it lies behind, negative if they pass by
};

/// How the face c → d stands to a → b, each with its room on the left; none unless they run against
/// each other with at least this cosine between their lines. a ≠ b, c ≠ d.
[[nodiscard]] std::optional<FarFace> FarFaceOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                               const Eigen::Vector2d& c, const Eigen::Vector2d& d,
                                               double min_cosine);

/// Finds for every wall the room behind it, no farther than max_wall_m, and how thick the wall is
/// between the two faces: measured where pictures show both, else assumed. Walls without a room
/// behind keep what they have. Cost: O(walls²).
void MeasureThickness(double max_wall_m, Storey& storey);

}  // namespace enfilade
