// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "enfilade/floorplan/types.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

/// The true plan in the home frame, storey by storey: rooms by their inner faces, one wall per wall
/// face (ids as in HomeWalls), one opening per hole on the face of its first room; cameras without
/// picture hash. No id is used on two storeys.
[[nodiscard]] Floorplan TruthFloorplan(const Home& home);

/// A vertical surface seen from above.
struct PlanSegment {
  Eigen::Vector2d a, b;
  int room_id = 0;
  int wall_id = -1;  ///< −1 on door reveals, door leaves and furniture
};

/// What stands in the way of a level look through the home, as segments.
struct PlanSegments {
  std::vector<PlanSegment> walls;  ///< wall faces (windows and closed doors are wall) and reveals
  std::vector<PlanSegment> obstacles;  ///< furniture on the floor and open door leaves
};

/// The segments of one storey. Passable openings are gaps in `walls`. Furniture that hangs more
/// than 0.5 m above the floor is no obstacle.
[[nodiscard]] PlanSegments MakePlanSegments(const Home& home, int storey_idx = 0);

struct PlanHit {
  double distance_m = 0;
  int segment_idx = 0;
};

/// First segment along the unit `direction` from `origin`; none when the ray leaves. Cost O(n).
[[nodiscard]] std::optional<PlanHit> CastPlanRay(const std::vector<PlanSegment>& segments,
                                                 const Eigen::Vector2d& origin,
                                                 const Eigen::Vector2d& direction);

/// Share of the line between walls and floor that furniture hides from the cameras, each looking
/// level into 360 directions: the foot of the wall in view is behind a box. Doors in view do not
/// count.
[[nodiscard]] double HiddenFloorLineShare(const Home& home);

}  // namespace enfilade
