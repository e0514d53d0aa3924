// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/joined_rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

Opening Passage(OpeningKind kind, double width_m, int room_id, std::optional<int> other_room_id) {
  Opening opening;
  opening.kind = kind;
  opening.b = {width_m, 0};
  opening.a = {0, 0};
  opening.room_id = room_id;
  opening.other_room_id = other_room_id;
  return opening;
}

TEST(FirstJoinedRooms, WideOpeningsJoinDirectlyAndThroughOthers) {
  Storey storey;
  for (const int id : {7, 3, 9, 4, 5}) storey.rooms.emplace_back().id = id;
  storey.openings = {Passage(OpeningKind::kOpening, 1.8, 4, 9),
                     Passage(OpeningKind::kOpening, 2.4, 9, 7),
                     Passage(OpeningKind::kOpening, 1.1, 7, 3),  // a doorway without a door
                     Passage(OpeningKind::kDoor, 1.6, 3, 5),     // a double door
                     Passage(OpeningKind::kOpening, 3, 5, {}),   // to the outside
                     Passage(OpeningKind::kOpening, 3, 5, 77)};  // to a room that is not there
  EXPECT_THAT(FirstJoinedRooms(storey), ::testing::ElementsAre(0, 1, 0, 0, 4));
  EXPECT_THAT(FirstJoinedRooms({}), ::testing::IsEmpty());
}

// Two rooms of 2 m × 2 m with a wall of 10 cm between them, y = 2 … 2.1, and a passage in it at
// x = 0.3 … 1.7 that is drawn on the lower room's face.
Storey TwoRooms() {
  Storey storey;
  storey.rooms.resize(2);
  storey.rooms[0].id = 4;
  storey.rooms[0].polygon.outer = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  storey.rooms[1].id = 9;
  storey.rooms[1].polygon.outer = {{0, 2.1}, {2, 2.1}, {2, 4.1}, {0, 4.1}};
  Wall& wall = storey.walls.emplace_back();
  wall.id = 6;
  wall.room_id = 4;
  wall.a = {2, 2};
  wall.b = {0, 2};
  wall.thickness_m = 0.3;
  Opening passage = Passage(OpeningKind::kOpening, 0, 4, 9);
  passage.wall_id = 6;
  passage.a = {1.7, 2};
  passage.b = {0.3, 2};
  storey.openings = {passage};
  return storey;
}

TEST(ThroughWall, GoesToTheOutlineBehindElseThroughTheWallsThickness) {
  Storey storey = TwoRooms();
  EXPECT_NEAR((ThroughWall(storey, storey.openings[0]) - Eigen::Vector2d(0, 0.1)).norm(), 0, 1e-9);
  storey.openings[0].other_room_id.reset();
  EXPECT_NEAR((ThroughWall(storey, storey.openings[0]) - Eigen::Vector2d(0, 0.3)).norm(), 0, 1e-9);
  storey.openings[0].wall_id = 1;
  EXPECT_EQ(ThroughWall(storey, storey.openings[0]), Eigen::Vector2d(0, 0));
}

TEST(Passages, JoinBothRoomsWhereverInTheWallTheyAreDrawn) {
  for (const double y : {2.0, 2.05}) {
    Storey storey = TwoRooms();
    storey.openings[0].a.y() = storey.openings[0].b.y() = y;
    const std::vector<MultiPolygon2> passages = Passages(storey);
    ASSERT_EQ(passages.size(), 2U);
    EXPECT_TRUE(passages[1].empty());
    const MultiPolygon2 joined =
        Union({storey.rooms[0].polygon, storey.rooms[1].polygon}, passages[0]);
    ASSERT_EQ(joined.size(), 1U) << y;
    EXPECT_NEAR(Area(joined), 2 * 4 + 0.1 * 1.4, 1e-6) << y;
  }
}

TEST(Passages, OnlyOfOpeningsThatJoinRooms) {
  Storey storey = TwoRooms();
  storey.openings[0].kind = OpeningKind::kDoor;
  EXPECT_TRUE(Passages(storey)[0].empty());
  storey.openings[0].kind = OpeningKind::kOpening;
  storey.openings[0].b.x() = 1;  // 0.7 m
  EXPECT_TRUE(Passages(storey)[0].empty());
  EXPECT_TRUE(Passages({}).empty());
}

}  // namespace
}  // namespace enfilade
