// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/types.h"
#include "src/floorplan/door_frames.h"
#include "src/floorplan/facade.h"

namespace enfilade {

/// A wall of a room, or where one may be, with what pictures show of it.
struct PicturedWall {
  PicturedWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int storey,
               const Polygon2& in_room, double floor, double ceiling, double step_m)
      : a(from),
        b(to),
        storey_idx(storey),
        room(&in_room),
        floor_z(floor),
        ceiling_z(ceiling),
        facade(from, to, floor, ceiling, step_m) {}

  Eigen::Vector2d a, b;  ///< the room on the left
  int storey_idx = 0;
  const Polygon2* room = nullptr;  ///< not owned
  double floor_z = 0, ceiling_z = 0;
  double door_log_odds = 0;  ///< what speaks for a door but the pictures
  Facade facade;
  std::vector<DoorFrame> frames;
};

class FacadeStore;

/// Shorter walls show no door and no opening.
inline constexpr double kMinPicturedWall_m = 0.55;

/// Shows every wall to the views that stand in its room, but those that `store` has a facade of:
/// they take it. Pictures are read as many at a time as there are threads, and added in their
/// order; views without a path, or in no such room, are passed over.
void LookAtWalls(const Scene& scene, const Rigid3& home_from_world, FacadeStore& store,
                 RunContext& context, std::vector<PicturedWall>& walls);

/// Finds the door frames of all walls, preferring those with the home's usual head, whose height is
/// returned; none when no wall shows a frame.
std::optional<double> FindFrames(RunContext& context, std::vector<PicturedWall>& walls);

/// A frame that may be a door's, an opening's or a window's.
struct DoorCandidate {
  size_t wall = 0;  ///< index of the pictured wall
  DoorFrame frame;
  Eigen::Vector2d a, b;
  double log_odds = 0;  ///< of a door; an opening's or window's strength
  double sill_m = 0;    ///< above the floor

  [[nodiscard]] Eigen::Vector2d Middle() const { return 0.5 * (a + b); }
  /// Unit, out of the room.
  [[nodiscard]] Eigen::Vector2d Outward() const {
    const Eigen::Vector2d along = (b - a).normalized();
    return {along.y(), -along.x()};
  }
};

/// The frames of one storey's walls as doors, surest first. Of a door seen from both sides of a
/// wall up to max_wall_m thick the surer side is kept; two sides that agree count for each other.
/// `cameras`: positions in the plan.
[[nodiscard]] std::vector<DoorCandidate> FindDoors(const std::vector<PicturedWall>& walls,
                                                   int storey_idx,
                                                   const std::vector<Eigen::Vector2d>& cameras,
                                                   double home_head_m, double max_wall_m);

/// The wide frames of one storey's walls that are clear enough for an opening, clearest first; of
/// one seen from both sides the clearer side. Where both sides were looked at both must show it.
[[nodiscard]] std::vector<DoorCandidate> FindWideOpenings(const std::vector<PicturedWall>& walls,
                                                          int storey_idx, double min_strength,
                                                          double max_wall_m);

/// The windows of one storey's walls, clearest first.
[[nodiscard]] std::vector<DoorCandidate> FindWindows(const std::vector<PicturedWall>& walls,
                                                     int storey_idx, double min_strength);

/// True for one door or opening seen from the two sides of a wall, or for the same.
[[nodiscard]] bool AreInOnePlace(const DoorCandidate& a, const DoorCandidate& b, double max_wall_m);

/// Camera positions of a storey in the plan.
[[nodiscard]] std::vector<Eigen::Vector2d> CamerasInPlan(const Scene& scene,
                                                         const Rigid3& home_from_world,
                                                         int storey_idx);

}  // namespace enfilade
