// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/room_outline.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// A panorama of one component: where it stands in the component's frame and what is about it.
struct RoomView {
  int view_idx = 0;
  Eigen::Vector3d position{0, 0, 0};  ///< metres
  const RoomOutline* outline = nullptr;
};

/// A feature of a panorama.
struct RoomRay {
  Eigen::Vector3d ray{0, 0, 1};  ///< unit, in the component's frame
  double surface_m = 0;          ///< distance of the own room's surface
  /// Logarithm of the size it would have at unit distance, up to a constant; NaN: unknown.
  double log_size = std::numeric_limits<double>::quiet_NaN();
};

/// The matches between a panorama of component a and one of component b.
struct ViewPairMatches {
  RoomView a, b;
  std::vector<RoomRay> rays_a, rays_b;  ///< of match i
  std::vector<FeatureMatch> matches;
};

/// How component b lies in the frame of component a: turned by `yaw_rad` about z, then moved;
/// heights stay.
struct Placement {
  double yaw_rad = 0;
  Eigen::Vector2d shift_m{0, 0};

  [[nodiscard]] Rigid3 Transform() const {
    return {RotationZ(yaw_rad), {shift_m.x(), shift_m.y(), 0}};
  }
};

/// Matches that agree with a placement and whose lines of sight pass one door.
struct DoorSight {
  int num_spots = 0;                         ///< different places that are seen through it
  std::vector<std::vector<size_t>> inliers;  ///< per view pair, ascending indices of matches
};

/// Which matches agree with a placement as sights through one door.
///
/// Of a match that agrees the two rays meet within `bound_rad` of a common plane with the baseline,
/// on a surface of one of both rooms and beyond the walls of the other, and their features are as
/// large as the distances say (FitSizes); where the second ray leaves its own room there must be
/// the door, for all of them the same. Matches of one place (30 cm) count once, however many
/// panoramas show it. Level rays are left out: every level baseline explains them.
///
/// `roll` > 0 pairs each ray of a with the ray of b of another match instead: what agrees then
/// agrees by chance. Cost: O(matches).
[[nodiscard]] DoorSight LookThroughDoor(std::span<const ViewPairMatches> pairs,
                                        const Placement& placement, double bound_rad, int roll = 0);

/// The shifts that a match allows at a yaw if what it shows lies on a surface of a's room, and if
/// it lies on one of b's: at most one each.
[[nodiscard]] std::vector<Eigen::Vector2d> ShiftsOf(const ViewPairMatches& pair, size_t match,
                                                    double yaw_rad);

}  // namespace enfilade
