// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/text_home.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace enfilade {
namespace {

using ::testing::IsEmpty;

constexpr const char* kTwoRooms =
    "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 height 2.7 | door 4,1 4,1.8 | window 1,0 2,0";

TEST(TextHome, JoinsRoomsThroughTheDoorBetweenThem) {
  const Home home = TextHome(kTwoRooms);
  EXPECT_THAT(HomeProblems(home), IsEmpty());
  ASSERT_EQ(home.rooms.size(), 2u);
  EXPECT_DOUBLE_EQ(home.rooms[0].ceiling_z, 2.5);
  EXPECT_DOUBLE_EQ(home.rooms[1].ceiling_z, 2.7);
  ASSERT_EQ(home.openings.size(), 2u);
  EXPECT_EQ(home.openings[0].room_id, 0);
  EXPECT_EQ(home.openings[0].other_room_id, 1);
  EXPECT_NEAR(home.openings[0].thickness_m, 0.1, 1e-12);
  EXPECT_TRUE(home.openings[0].IsPassable());
  EXPECT_EQ(home.openings[1].kind, OpeningKind::kWindow);
  EXPECT_FALSE(home.openings[1].other_room_id.has_value());
  EXPECT_EQ(home.cameras.size(), 2u);  // one a room by default
}

TEST(TextHome, ReadsHolesBoxesCamerasAndClosedDoors) {
  const Home home = TextHome(
      "camera 1,1 | room 0,0 6,0 6,4 0,4 | hole 3,2 3,2.4 3.4,2.4 3.4,2 | closed 6,1.8 6,1 | "
      "box 4,3 5,3.6 height 2");
  EXPECT_THAT(HomeProblems(home), IsEmpty());
  EXPECT_EQ(home.rooms[0].polygon.holes.size(), 1u);
  ASSERT_EQ(home.boxes.size(), 1u);
  EXPECT_NEAR(home.boxes[0].size.y(), 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(home.boxes[0].z1, 2.0);
  ASSERT_EQ(home.cameras.size(), 1u);
  EXPECT_EQ(home.cameras[0].home_from_cam.translation, Eigen::Vector3d(1, 1, 1.5));
  EXPECT_EQ(home.openings[0].leaf, DoorLeaf::kClosed);
  // Turned so that the room is on the left.
  EXPECT_EQ(home.openings[0].a, Eigen::Vector2d(6, 1));
}

TEST(TextHome, RefusesMalformedText) {
  EXPECT_THROW((void)TextHome(""), std::logic_error);
  EXPECT_THROW((void)TextHome("room 0,0 1,0"), std::logic_error);
  EXPECT_THROW((void)TextHome("room 0,0 4,0 4,3 0,3 | door 1,1 2,1"), std::logic_error);
  EXPECT_THROW((void)TextHome("room 0,0 4,0 4,3 0,3 | gate 1,0 2,0"), std::logic_error);
  EXPECT_THROW((void)TextHome("room 0,0 4,0 4,3 0,3 | camera 9,9"), std::logic_error);
}

TEST(HomeProblems, StoreysNeedAFloorBetween) {
  // One room above the other.
  Home home =
      TextHome("room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8 height 2.5");
  EXPECT_THAT(HomeProblems(home), IsEmpty());
  const auto num_problems = [&] { return HomeProblems(home).size(); };
  home.rooms[1].storey_idx = 1;
  EXPECT_EQ(num_problems(), 1u);  // as high as the first
  home.rooms[1].floor_z += 2.9;
  home.rooms[1].ceiling_z += 2.9;
  EXPECT_GE(num_problems(), 1u);  // the door leads to another storey, the camera has stayed below
  home.openings.clear();
  home.cameras.pop_back();
  EXPECT_EQ(num_problems(), 0u);
  home.rooms[1].polygon = home.rooms[0].polygon;
  EXPECT_EQ(num_problems(), 0u);
  home.rooms[1].storey_idx = 2;
  EXPECT_GE(num_problems(), 1u);  // no room on the storey between
}

TEST(HomeProblems, FindsEachPlantedFault) {
  const std::string room = "room 0,0 4,0 4,3 0,3 | ";
  const auto problems = [](const std::string& text) { return HomeProblems(TextHome(text)).size(); };
  EXPECT_EQ(problems(room + "room 4.01,0 8,0 8,3 4.01,3"), 1u);      // no wall between
  EXPECT_EQ(problems("room 0,0 4,3 4,0 0,3 | camera 0.1,1.5"), 1u);  // crosses itself
  EXPECT_EQ(problems(room + "window 1,0 2,0 | window 1.5,0 2.5,0"), 1u);
  EXPECT_EQ(problems(room + "box 3,1 4.5,2 | camera 1,1"), 1u);  // through a wall
  EXPECT_EQ(problems(room + "box 1,2.5 2,3 | closed 1,3 1.8,3 | camera 1,1"), 1u);
  Home overhead = TextHome(room + "box 1,2.5 2,3 | closed 1,3 1.8,3 | camera 3,1");
  EXPECT_EQ(HomeProblems(overhead).size(), 1u);
  overhead.boxes[0].z0 = 2.1;  // above the door
  overhead.boxes[0].z1 = 2.5;
  EXPECT_EQ(HomeProblems(overhead).size(), 0u);
  Home two_boxes = TextHome(room + "box 1,1 2,2 | box 1.5,1.5 3,2.5 | camera 3.5,0.5");
  EXPECT_EQ(HomeProblems(two_boxes).size(), 1u);
  two_boxes.boxes[1].item = two_boxes.boxes[0].item;  // parts of one piece may touch
  EXPECT_EQ(HomeProblems(two_boxes).size(), 0u);
  EXPECT_EQ(problems(room + "camera 3.8,1"), 1u);
  Home low = TextHome(room + "closed 1,0 1.8,0");
  low.openings[0].head_z = 2.6;
  EXPECT_EQ(HomeProblems(low).size(), 1u);
}

}  // namespace
}  // namespace enfilade
