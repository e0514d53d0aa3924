// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What of a wall meets the eye of one column of a panorama, in the plan.
struct WallSighting {
  double along_m = 0;        ///< where on the wall the column's ray ends, from its end a
  double distance_m = 0;     ///< from the camera to there
  double incidence_rad = 0;  ///< between the ray and the wall's normal, in [0, π/2)
  double profile_m = 0;      ///< distance of the structural wall in the panorama's profile
};

/// What one panorama says about one wall.
struct WallWitness {
  int view_idx = 0;
  double distance_m = 0;      ///< of the camera from the wall's line
  double range_m = 0;         ///< median distance of the points seen
  double incidence_rad = 0;   ///< median
  double agreeing_share = 0;  ///< of the columns: those whose profile lies within 5 % of the wall
  double offset_m = 0;  ///< median of where the profile has the wall: positive beyond it, outwards
  std::vector<WallSighting> sightings;  ///< one a column that sees the wall, in column order
};

/// A column agrees with a wall that its profile has within this share of its distance.
inline constexpr double kAgreement = 0.05;

[[nodiscard]] bool Agrees(const WallSighting& sighting);

/// For every wall of a storey the panoramas that see it, in the order of `structure.profiles`.
///
/// Each column's ray runs through the plan up to the first wall face that is no door or opening;
/// the wall is seen if the ray comes from its room. Columns that the picture does not cover are
/// left out. Cost: a column looks at the walls in its direction only.
[[nodiscard]] std::vector<std::vector<WallWitness>> FindWallWitnesses(const Scene& scene,
                                                                      const Structure& structure,
                                                                      const Storey& storey,
                                                                      int storey_idx);

}  // namespace enfilade
