// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/judged_plan.h"

#include <gtest/gtest.h>

#include "enfilade/geometry/boolean.h"
#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

double TotalLength(const std::vector<Segment2>& segments) {
  double length = 0;
  for (const Segment2& segment : segments) length += (segment[1] - segment[0]).norm();
  return length;
}

TEST(JudgedPlan, OfAPlanIsInTheWorld) {
  const SmallHome home = MakeSmallHome();
  const JudgedPlan plan = JudgedPlanOf(home.plan);
  ASSERT_EQ(plan.rooms.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(AreaIou(plan.rooms[i].region, home.truth.rooms[i].region), 1, 1e-9);
    EXPECT_NEAR(*plan.rooms[i].ceiling_m, *home.truth.rooms[i].ceiling_z, 1e-9);
  }
  EXPECT_NEAR(TotalLength(plan.walls), TotalLength(home.truth.walls), 1e-9);
  ASSERT_EQ(plan.doors.size(), 2U);
  EXPECT_NEAR((plan.doors[1][0] - Vector2d(6, 3.05)).norm(), 0, 1e-9);
}

TEST(JudgedPlan, WindowsAreWall) {
  std::vector<Opening> openings = SmallHomeDoors();
  openings[0].kind = OpeningKind::kWindow;
  const JudgedPlan plan = JudgedPlanOf(MakePlan(SmallHomeRooms(), openings));
  EXPECT_NEAR(TotalLength(plan.walls), TotalLength(MakeSmallHome().truth.walls) + 2 * 0.9, 1e-9);
  EXPECT_EQ(plan.doors.size(), 1U);
}

TEST(JudgedPlan, AWideOpeningMakesOneRoom) {
  std::vector<Opening> openings = SmallHomeDoors();
  openings[1].kind = OpeningKind::kOpening;  // 0.9 m: a narrow one
  EXPECT_EQ(JudgedPlanOf(MakePlan(SmallHomeRooms(), openings)).rooms.size(), 3U);
  openings[1].b.x() += 0.4;
  const JudgedPlan plan = JudgedPlanOf(MakePlan(SmallHomeRooms(), openings));
  ASSERT_EQ(plan.rooms.size(), 2U);
  ASSERT_EQ(plan.rooms[1].region.size(), 1U);
  EXPECT_NEAR(Area(plan.rooms[1].region), 4 * 3 + 8.1 * 1.5 + 1.3 * 0.1, 1e-9);
  openings[1].kind = OpeningKind::kDoor;  // a wide door is a door
  EXPECT_EQ(JudgedPlanOf(MakePlan(SmallHomeRooms(), openings)).rooms.size(), 3U);
}

TEST(JudgedPlan, TheTruthJoinsWhatAPlanJoins) {
  SmallHome home = MakeSmallHome();
  home.truth.rooms[2].joined_to = 1;
  const Ring2 passage = {{6, 2.99}, {6.9, 2.99}, {6.9, 3.11}, {6, 3.11}};
  home.truth.rooms[2].passages = {{passage, {}}};
  const double smaller_m2 = Area(home.truth.rooms[1].region);
  const double larger_m2 = Area(home.truth.rooms[2].region);
  home.truth.rooms[1].ceiling_z = 9;
  const JudgedPlan plan = JudgedPlanOf(home.truth);
  ASSERT_EQ(plan.rooms.size(), 2U);
  ASSERT_EQ(plan.rooms[1].region.size(), 1U);
  EXPECT_NEAR(Area(plan.rooms[1].region), smaller_m2 + larger_m2 + 0.9 * 0.1, 1e-9);
  ASSERT_LT(smaller_m2, larger_m2);
  EXPECT_LT(*plan.rooms[1].ceiling_m, 5);
}

TEST(JudgedPlan, ARoomWithoutLevelCeilingHasNoHeight) {
  SmallHome home = MakeSmallHome();
  home.truth.rooms[1].ceiling_z.reset();
  const JudgedPlan plan = JudgedPlanOf(home.truth);
  EXPECT_TRUE(plan.rooms[0].ceiling_m);
  EXPECT_FALSE(plan.rooms[1].ceiling_m);
}

TEST(CutOpenings, TakesOutExactlyWhatTheOpeningCovers) {
  const std::vector<Segment2> wall = {{Vector2d(0, 0), Vector2d(5, 0)}};
  const auto parts = CutOpenings(wall, {{Vector2d(2, 0.1), Vector2d(1, 0.1)},
                                        {Vector2d(1.5, -0.1), Vector2d(2.5, -0.1)},
                                        {Vector2d(4.5, 0), Vector2d(6, 0)}});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR((parts[0][0] - Vector2d(0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((parts[0][1] - Vector2d(1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((parts[1][0] - Vector2d(2.5, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((parts[1][1] - Vector2d(4.5, 0)).norm(), 0, 1e-12);
}

TEST(CutOpenings, LeavesAloneWhatIsFarOrAcross) {
  const std::vector<Segment2> wall = {{Vector2d(0, 0), Vector2d(5, 0)}};
  EXPECT_NEAR(TotalLength(CutOpenings(wall, {{Vector2d(1, 0.4), Vector2d(2, 0.4)}})), 5, 1e-12);
  EXPECT_NEAR(TotalLength(CutOpenings(wall, {{Vector2d(2, -0.5), Vector2d(2, 0.5)}})), 5, 1e-12);
  EXPECT_NEAR(TotalLength(CutOpenings(wall, {{Vector2d(7, 0), Vector2d(8, 0)}})), 5, 1e-12);
  EXPECT_TRUE(CutOpenings(wall, {{Vector2d(-1, 0), Vector2d(6, 0)}}).empty());
}

TEST(MergeDoors, OneDoorForBothFacesOfAWall) {
  const std::vector<Segment2> doors = {{Vector2d(1, 3), Vector2d(1.9, 3)},
                                       {Vector2d(6, 3), Vector2d(6.8, 3)},
                                       {Vector2d(1, 3.2), Vector2d(1.95, 3.2)},
                                       {Vector2d(6, 3.5), Vector2d(6.8, 3.5)}};
  const std::vector<Segment2> merged = MergeDoors(doors);
  ASSERT_EQ(merged.size(), 3U);
  EXPECT_EQ(merged[0][1], Vector2d(1.95, 3.2));
  EXPECT_EQ(merged[1][1], Vector2d(6.8, 3));
}

}  // namespace
}  // namespace enfilade
