// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/shut_closets.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "enfilade/geometry/boolean.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/storey_of_rooms.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kWall_m = 0.12;

// Rooms with a door in the middle of the wall of room 0 that runs through `on_wall`.
Storey StoreyWithDoor(const std::vector<Polygon2>& rooms, const Vector2d& on_wall) {
  Storey storey = StoreyOf(rooms);
  for (Room& room : storey.rooms) room.floor_z = 0.1;
  for (const Wall& wall : storey.walls) {
    if (wall.room_id != 0 || DistanceToSegment(on_wall, wall.a, wall.b) > 0.01) continue;
    const Vector2d half = 0.4 * (wall.b - wall.a).normalized();
    Opening door;
    door.wall_id = wall.id;
    door.a = 0.5 * (wall.a + wall.b) - half;
    door.b = 0.5 * (wall.a + wall.b) + half;
    door.head_z = 2.1;
    storey.openings.push_back(door);
  }
  return storey;
}

// The closet that is added behind the door, if any.
std::optional<Room> ClosetOf(const std::vector<Polygon2>& rooms, const Vector2d& door_at,
                             const FloorplanOptions& options = {}) {
  Storey storey = StoreyWithDoor(rooms, door_at);
  EXPECT_EQ(storey.openings.size(), 1u);
  const int num_added = AddShutClosets(options, storey);
  EXPECT_EQ(storey.rooms.size(), rooms.size() + static_cast<size_t>(num_added));
  EXPECT_EQ(storey.openings[0].other_room_id.has_value(), num_added == 1);
  Floorplan plan;
  plan.storeys.push_back(storey);
  ExpectValidFloorplan(plan);
  if (num_added == 0) return std::nullopt;
  for (const Wall& wall : storey.walls) {
    EXPECT_TRUE(wall.room_id != storey.rooms.back().id || wall.seen == WallSeen::kInferred);
  }
  EXPECT_EQ(*storey.openings[0].other_room_id, storey.rooms.back().id);
  EXPECT_EQ(storey.walls[static_cast<size_t>(storey.openings[0].wall_id)].other_room_id,
            storey.rooms.back().id);
  return storey.rooms.back();
}

void ExpectRegion(const std::optional<Room>& room, const Polygon2& region) {
  ASSERT_TRUE(room.has_value());
  EXPECT_EQ(room->polygon.outer.size(), region.outer.size());
  EXPECT_GT(AreaIou({room->polygon}, {region}), 0.999);
  EXPECT_EQ(room->floor_z, 0.1);
  EXPECT_EQ(room->ceiling_z, 2.4);
}

TEST(ShutClosets, TheCornerThatARoomGoesRound) {
  const Polygon2 room{ParseRing("0,0 4,0 4,3 1.5,3 1.5,2 0,2"), {}};
  ExpectRegion(ClosetOf({room}, {0.75, 2}), Box(0, 2 + kWall_m, 1.5 - kWall_m, 3));
}

TEST(ShutClosets, TheMiddleOfAnOuterWall) {
  const Polygon2 room{ParseRing("0,0 4,0 4,3 3,3 3,2 1,2 1,3 0,3"), {}};
  ExpectRegion(ClosetOf({room}, {2, 2}), Box(1 + kWall_m, 2 + kWall_m, 3 - kWall_m, 3));
}

TEST(ShutClosets, BetweenTwoRoomsBesideItsOwnUpToTheNearerEnd) {
  const std::vector<Polygon2> rooms = {Box(0, 0, 2, 3), Box(-3, 0, -0.12, 4), Box(2.12, 0, 5, 4.5)};
  ExpectRegion(ClosetOf(rooms, {1, 3}), Box(0, 3 + kWall_m, 2, 4));
}

TEST(ShutClosets, NotWhereTheRoomsEndWithTheWall) {
  EXPECT_FALSE(ClosetOf({Box(0, 0, 4, 3)}, {2, 3}));
}

TEST(ShutClosets, NotWhereTheRoomBesideEndsTooFarOut) {
  // What ends at the door's wall is more than what ends with the room beside it.
  const std::vector<Polygon2> rooms = {Box(0, 0, 2, 3), Box(2.12, 0, 5, 4), Box(-4, 0, -0.12, 3)};
  EXPECT_FALSE(ClosetOf(rooms, {1, 3}));
  std::vector<Polygon2> longer = rooms;
  longer.push_back(Box(5.12, 0, 8, 4));
  EXPECT_TRUE(ClosetOf(longer, {1, 3}));
}

TEST(ShutClosets, NotAsDeepAsAYardNorAsShallowAsACupboard) {
  for (const auto& [depth, is_closet] :
       {std::pair{0.7, false}, {1.0, true}, {1.5, true}, {1.7, false}}) {
    SCOPED_TRACE(depth);
    const Ring2 ring = {{0, 0}, {4, 0}, {4, 2 + depth}, {1.5, 2 + depth}, {1.5, 2}, {0, 2}};
    EXPECT_EQ(ClosetOf({{ring, {}}}, {0.75, 2}).has_value(), is_closet);
  }
  FloorplanOptions options;
  options.unseen_hole_m2 = 1;  // 1.38 × 0.88 m
  const Polygon2 room{ParseRing("0,0 4,0 4,3 1.5,3 1.5,2 0,2"), {}};
  EXPECT_FALSE(ClosetOf({room}, {0.75, 2}, options));
}

TEST(ShutClosets, WhatAnotherRoomTakesOfTheSpaceIsLeftToIt) {
  const std::vector<Polygon2> rooms = {{ParseRing("0,0 4,0 4,3.5 1.5,3.5 1.5,2 0,2"), {}},
                                       Box(-2, 3.12, 1.2, 5)};
  ExpectRegion(ClosetOf(rooms, {0.75, 2}), Box(0, 2 + kWall_m, 1.5 - kWall_m, 3));
}

TEST(ShutClosets, DoorsThatLeadIntoARoomStay) {
  Storey storey = StoreyWithDoor({{ParseRing("0,0 4,0 4,3 1.5,3 1.5,2 0,2"), {}}}, {0.75, 2});
  storey.openings[0].other_room_id = 0;
  EXPECT_EQ(AddShutClosets({}, storey), 0);
  storey.openings[0].other_room_id.reset();
  storey.openings[0].kind = OpeningKind::kWindow;
  EXPECT_EQ(AddShutClosets({}, storey), 0);
}

}  // namespace
}  // namespace enfilade
