// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/doors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

using testing::ElementsAre;
using testing::Pair;

DoorFigures Judge(const std::vector<Opening>& openings) {
  return EvaluateDoors(JudgedPlanOf(MakePlan(SmallHomeRooms(), openings)),
                       JudgedPlanOf(MakeSmallHome().truth));
}

TEST(DoorGraph, JoinsTheRoomsOnEitherSide) {
  EXPECT_THAT(DoorGraph(JudgedPlanOf(MakeSmallHome().truth)), ElementsAre(Pair(0, 2), Pair(1, 2)));
}

TEST(DoorGraph, DoorsOutOfTheHomeJoinNothing) {
  SmallHome home = MakeSmallHome();
  home.truth.doors = {{Eigen::Vector2d(1, 0), Eigen::Vector2d(2, 0)}};
  EXPECT_TRUE(DoorGraph(JudgedPlanOf(home.truth)).empty());
}

TEST(EvaluateDoors, TruthAgainstItselfIsPerfect) {
  const DoorFigures figures = Judge(SmallHomeDoors());
  EXPECT_EQ(figures.precision, 1.0);
  EXPECT_EQ(figures.recall, 1.0);
  EXPECT_EQ(figures.graph_precision, 1.0);
  EXPECT_EQ(figures.graph_recall, 1.0);
}

TEST(EvaluateDoors, AMissingAndAMovedDoor) {
  std::vector<Opening> doors = SmallHomeDoors();
  doors.pop_back();
  EXPECT_EQ(Judge(doors).precision, 1.0);
  EXPECT_EQ(Judge(doors).recall, 0.5);
  EXPECT_EQ(Judge(doors).graph_recall, 0.5);
  doors[0].a.x() += 0.5;
  doors[0].b.x() += 0.5;  // too far for a hit, but it joins the same rooms
  EXPECT_EQ(Judge(doors).precision, 0.0);
  EXPECT_EQ(Judge(doors).graph_precision, 1.0);
}

TEST(EvaluateDoors, AFalseDoorCostsPrecision) {
  std::vector<Opening> doors = SmallHomeDoors();
  Opening between = doors[0];
  between.a = Eigen::Vector2d(4.05, 1);
  between.b = Eigen::Vector2d(4.05, 1.9);
  between.other_room_id = 1;
  doors.push_back(between);
  EXPECT_NEAR(*Judge(doors).precision, 2.0 / 3, 1e-12);
  EXPECT_EQ(Judge(doors).recall, 1.0);
  EXPECT_NEAR(*Judge(doors).graph_precision, 2.0 / 3, 1e-12);
}

TEST(EvaluateDoors, NoDoorsGiveNone) {
  EXPECT_EQ(Judge({}).precision, std::nullopt);
  EXPECT_EQ(Judge({}).recall, std::nullopt);
}

}  // namespace
}  // namespace enfilade
