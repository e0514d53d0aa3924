// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/standing_space.h"

#include <algorithm>
#include <limits>

#include "src/synthetic/outline.h"
#include "src/synthetic/placement.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// The hole of a door or opening, from face to face.
Ring2 HoleOf(const HomeOpening& opening) {
  const Vector2d through = opening.thickness_m * opening.IntoWall();
  return {opening.b, opening.a, opening.a + through, opening.b + through};
}

}  // namespace

StandingSpace::StandingSpace(const Home& home, int storey_idx)
    : home_(home),
      storey_idx_(storey_idx),
      solid_(MakePlanSegments(home, storey_idx)),
      holes_(home.openings.size()) {
  for (const HomeBox& box : home.boxes) {
    if (!home.IsOnStorey(box.room_id, storey_idx)) continue;
    if (box.z0 - home.RoomById(box.room_id).floor_z < kHeadroom_m)
      things_.push_back(box.Footprint());
  }
  for (size_t i = 0; i < home.openings.size(); ++i) {
    const HomeOpening& opening = home.openings[i];
    if (!home.IsOnStorey(opening.room_id, storey_idx)) continue;
    if (opening.IsPassable()) holes_[i] = HoleOf(opening);
    if (opening.leaf == DoorLeaf::kOpen) things_.push_back(OpenLeaf(opening).Footprint());
  }
}

std::optional<int> StandingSpace::RoomAt(const Vector2d& p) const {
  for (const HomeRoom& room : home_.rooms) {
    if (room.storey_idx == storey_idx_ && Contains(room.polygon, p)) return room.id;
  }
  for (size_t i = 0; i < holes_.size(); ++i) {
    if (!holes_[i].empty() && Contains(holes_[i], p)) return home_.openings[i].room_id;
  }
  return std::nullopt;
}

double StandingSpace::Clearance(const Vector2d& p) const {
  if (!RoomAt(p)) return -1;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const PlanSegment& wall : solid_.walls) {
    nearest_m = std::min(nearest_m, DistanceToSegment(p, wall.a, wall.b));
  }
  for (const Ring2& thing : things_) {
    nearest_m = std::min(nearest_m, Contains(thing, p) ? -1 : DistanceToRing(thing, p));
  }
  return nearest_m;
}

}  // namespace enfilade
