// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/text_home.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

TEST(TruthFloorplan, TellsNeighboursThicknessAndOpenings) {
  TextHomeOptions options;
  options.heading_rad = 0.3;
  options.floor_z = -0.4;
  const Floorplan plan = TruthFloorplan(
      TextHome("room 0,0 4,0 4,3 0,3 | room 4.12,1 8,1 8,3 4.12,3 | door 4,1.5 4,2.3", options));
  ASSERT_EQ(plan.storeys.size(), 1u);
  const Storey& storey = plan.storeys[0];
  EXPECT_DOUBLE_EQ(storey.floor_z, -0.4);
  ASSERT_EQ(storey.walls.size(), 8u);
  EXPECT_EQ(storey.walls[1].other_room_id, 1);
  EXPECT_NEAR(storey.walls[1].thickness_m, 0.12, 1e-12);
  EXPECT_EQ(storey.walls[7].other_room_id, 0);
  EXPECT_FALSE(storey.walls[0].other_room_id.has_value());
  ASSERT_EQ(storey.openings.size(), 1u);
  EXPECT_EQ(storey.openings[0].wall_id, 1);
  EXPECT_EQ(storey.openings[0].other_room_id, 1);
  // A home turned by +0.3 rad: its x axis has that heading in the world.
  const Eigen::Vector3d x_in_world = plan.home_from_world.Inverse() * Eigen::Vector3d(1, 0, 0);
  EXPECT_NEAR(std::atan2(x_in_world.y(), x_in_world.x()), 0.3, 1e-12);
  EXPECT_EQ(plan.cameras.size(), 2u);
}

TEST(TruthFloorplan, EveryStoreyHasItsOwnRoomsWallsAndCameras) {
  const Home home = MakeHome({.seed = 3, .storeys = 2});
  const Floorplan plan = TruthFloorplan(home);
  ASSERT_EQ(plan.storeys.size(), 2u);
  std::set<int> walls;
  size_t num_rooms = 0, num_openings = 0;
  for (size_t i = 0; i < plan.storeys.size(); ++i) {
    const Storey& storey = plan.storeys[i];
    EXPECT_EQ(storey.id, static_cast<int>(i));
    num_rooms += storey.rooms.size();
    num_openings += storey.openings.size();
    std::set<int> rooms;
    for (const Room& room : storey.rooms) {
      rooms.insert(room.id);
      EXPECT_DOUBLE_EQ(room.floor_z, storey.floor_z);
      EXPECT_EQ(home.RoomById(room.id).storey_idx, static_cast<int>(i));
    }
    for (const Wall& wall : storey.walls) {
      EXPECT_TRUE(walls.insert(wall.id).second);
      EXPECT_TRUE(rooms.contains(wall.room_id));
      EXPECT_TRUE(!wall.other_room_id || rooms.contains(*wall.other_room_id));
    }
    for (const Opening& opening : storey.openings) EXPECT_TRUE(rooms.contains(opening.room_id));
  }
  EXPECT_GT(plan.storeys[1].floor_z, plan.storeys[0].floor_z + 2.6 - 1e-9);
  EXPECT_EQ(num_rooms, home.rooms.size());
  EXPECT_EQ(num_openings, home.openings.size());
  EXPECT_EQ(walls.size(), HomeWalls(home).size());
  for (size_t i = 0; i < plan.cameras.size(); ++i)
    EXPECT_EQ(plan.cameras[i].storey_idx, home.StoreyOfCamera(static_cast<int>(i)));
}

TEST(MakePlanSegments, KnowsOneStoreyAtATime) {
  const Home home = MakeHome({.seed = 3, .storeys = 2});
  for (int storey_idx : {0, 1}) {
    const PlanSegments segments = MakePlanSegments(home, storey_idx);
    EXPECT_FALSE(segments.walls.empty());
    for (const auto* kind : {&segments.walls, &segments.obstacles}) {
      for (const PlanSegment& segment : *kind)
        EXPECT_EQ(home.RoomById(segment.room_id).storey_idx, storey_idx);
    }
  }
}

TEST(CastPlanRay, LooksThroughOpenDoorsAndStopsAtClosedOnes) {
  const std::string rooms = "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | camera 1,1.4 | ";
  const Home open = TextHome(rooms + "door 4,1 4,1.8");
  const Home closed = TextHome(rooms + "closed 4,1 4,1.8");
  const Vector2d eye(1, 1.4), east(1, 0);
  const PlanSegments open_segments = MakePlanSegments(open);
  EXPECT_NEAR(CastPlanRay(open_segments.walls, eye, east)->distance_m, 7, 1e-12);
  EXPECT_NEAR(CastPlanRay(MakePlanSegments(closed).walls, eye, east)->distance_m, 3, 1e-12);
  // A grazing look ends on the reveal between the two faces.
  const Vector2d grazing = (Vector2d(4.05, 1.8) - eye).normalized();
  const auto hit = CastPlanRay(open_segments.walls, eye, grazing);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR((eye + hit->distance_m * grazing - Vector2d(4.05, 1.8)).norm(), 0, 1e-9);
  EXPECT_EQ(open_segments.walls[static_cast<size_t>(hit->segment_idx)].wall_id, -1);
}

TEST(CastPlanRay, ObstaclesAreFurnitureOnTheFloorAndOpenLeaves) {
  Home home = TextHome("room 0,0 4,0 4,3 0,3 | box 2,1 3,2 | camera 1,1.5");
  const auto hit = CastPlanRay(MakePlanSegments(home).obstacles, {1, 1.5}, {1, 0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance_m, 1, 1e-12);
  home.boxes[0].z0 = 1.4;
  EXPECT_TRUE(MakePlanSegments(home).obstacles.empty());
  Home door = TextHome("room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8");
  door.openings[0].leaf = DoorLeaf::kOpen;
  door.openings[0].leaf_angle_rad = 1.57;
  const PlanSegments segments = MakePlanSegments(door);
  ASSERT_EQ(segments.obstacles.size(), 4u);
  // The leaf stands in the first room, as long as the door is wide.
  for (const PlanSegment& s : segments.obstacles) {
    EXPECT_LT(s.a.x(), 4.0);
    EXPECT_GT(s.a.x(), 3.1);
  }
}

TEST(HiddenFloorLineShare, IsWhatStandsBeforeTheWallsFoot) {
  const std::string room = "room 0,0 4,0 4,4 0,4 | camera 2,2";
  EXPECT_EQ(HiddenFloorLineShare(TextHome(room)), 0);
  // A box along a whole wall hides it, and what of the side walls lies beside it.
  EXPECT_NEAR(HiddenFloorLineShare(TextHome(room + " | box 3.2,0.01 3.98,3.99 height 1.2")),
              2 * std::atan2(2, 1.2) / (2 * kPi), 0.01);
  EXPECT_EQ(HiddenFloorLineShare(TextHome(room + " | box 2.6,1.9 2.7,2.1 height 0.3")), 0);
}

}  // namespace
}  // namespace enfilade
