// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/doors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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

// The twin: every way to give each true door one found door or none.
int SlowHits(const std::vector<Segment2>& truth, const std::vector<Segment2>& found,
             std::vector<bool>& is_taken, size_t next = 0) {
  if (next == truth.size()) return 0;
  int best = SlowHits(truth, found, is_taken, next + 1);
  const auto center = [](const Segment2& door) {
    return Eigen::Vector2d(0.5 * (door[0] + door[1]));
  };
  for (size_t j = 0; j < found.size(); ++j) {
    if (is_taken[j] || (center(truth[next]) - center(found[j])).norm() > kDoorDistance_m) continue;
    is_taken[j] = true;
    best = std::max(best, 1 + SlowHits(truth, found, is_taken, next + 1));
    is_taken[j] = false;
  }
  return best;
}

TEST(EvaluateDoors, HitsAgreeWithTheirBruteForceTwin) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(0, 1.5);
  const auto doors = [&](int count) {
    std::vector<Segment2> made;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d a(place(random), place(random));
      made.push_back({a, a + Eigen::Vector2d(0.8, 0)});
    }
    return made;
  };
  for (int round = 0; round < 50; ++round) {
    JudgedPlan truth, result;
    truth.doors = doors(5);
    result.doors = doors(4);
    std::vector<bool> is_taken(4, false);
    const int hits = SlowHits(truth.doors, result.doors, is_taken);
    EXPECT_NEAR(*EvaluateDoors(result, truth).recall, hits / 5.0, 1e-12);
    EXPECT_NEAR(*EvaluateDoors(result, truth).precision, hits / 4.0, 1e-12);
  }
}

TEST(EvaluateDoors, NoDoorsGiveNone) {
  EXPECT_EQ(Judge({}).precision, std::nullopt);
  EXPECT_EQ(Judge({}).recall, std::nullopt);
}

}  // namespace
}  // namespace enfilade
