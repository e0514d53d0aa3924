// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "enfilade/geometry/angles.h"
#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

using testing::ElementsAre;

RoomFigures Judge(const std::vector<Ring2>& rooms) {
  return EvaluateRooms(JudgedPlanOf(MakePlan(rooms, SmallHomeDoors())),
                       JudgedPlanOf(MakeSmallHome().truth));
}

TEST(EvaluateRooms, TruthAgainstItselfIsPerfect) {
  const RoomFigures figures = Judge(SmallHomeRooms());
  EXPECT_EQ(figures.total, 3);
  EXPECT_EQ(figures.iou50, 3);
  EXPECT_EQ(figures.iou70, 3);
  EXPECT_EQ(figures.iou90, 3);
  EXPECT_EQ(figures.split, 0);
  EXPECT_EQ(figures.merged, 0);
  EXPECT_EQ(figures.false_rooms, 0);
  EXPECT_EQ(figures.f1_10cm, 1.0);
  EXPECT_EQ(figures.corner_f1_10cm, 1.0);
  EXPECT_NEAR(*figures.ceiling_median_m, 0, 1e-9);
}

TEST(EvaluateRooms, AWallMovedBy7CentimetresIsWithinEveryBound) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.17,0 8.17,3 4.1,3");
  const RoomFigures figures = Judge(rooms);
  EXPECT_EQ(figures.iou90, 3);
  EXPECT_EQ(figures.f1_10cm, 1.0);
  EXPECT_EQ(figures.corner_f1_10cm, 1.0);
}

TEST(EvaluateRooms, AWallMovedBy30CentimetresLosesItsRoomAndCorners) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.4,0 8.4,3 4.1,3");
  const RoomFigures figures = Judge(rooms);
  EXPECT_EQ(figures.iou90, 3);  // 12 of 12.9 m²
  EXPECT_NEAR(*figures.f1_10cm, 2.0 / 3, 1e-12);
  EXPECT_NEAR(*figures.corner_f1_10cm, 10.0 / 12, 1e-12);
}

TEST(EvaluateRooms, TwoRoomsMerged) {
  const RoomFigures figures = Judge({ParseRing("0,0 8.1,0 8.1,3 0,3"), SmallHomeRooms()[2]});
  EXPECT_EQ(figures.merged, 1);
  EXPECT_EQ(figures.split, 0);
  EXPECT_EQ(figures.false_rooms, 0);
  EXPECT_EQ(figures.iou50, 1);  // 12 of 24.3 m² is less than half
  EXPECT_EQ(figures.iou90, 1);
  EXPECT_NEAR(*figures.f1_10cm, 2.0 / 5, 1e-12);
  EXPECT_NEAR(*figures.corner_f1_10cm, 2.0 * 8 / (12 + 8), 1e-12);
}

TEST(EvaluateRooms, ARoomSplit) {
  const RoomFigures figures = Judge({ParseRing("0,0 2.5,0 2.5,3 0,3"), SmallHomeRooms()[1],
                                     SmallHomeRooms()[2], ParseRing("2.6,0 4,0 4,3 2.6,3")});
  EXPECT_EQ(figures.split, 1);
  EXPECT_EQ(figures.merged, 0);
  EXPECT_EQ(figures.false_rooms, 0);
  EXPECT_EQ(figures.iou50, 3);
  EXPECT_EQ(figures.iou70, 2);
}

TEST(EvaluateRooms, ARoomLost) {
  const RoomFigures figures = Judge({SmallHomeRooms()[0], SmallHomeRooms()[1]});
  EXPECT_EQ(figures.total, 3);
  EXPECT_EQ(figures.iou50, 2);
  EXPECT_EQ(figures.split + figures.merged + figures.false_rooms, 0);
  EXPECT_NEAR(*figures.f1_10cm, 4.0 / 5, 1e-12);
}

TEST(EvaluateRooms, ARoomThatIsNotThere) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms.push_back(ParseRing("8.3,0 12,0 12,3 8.3,3"));
  const RoomFigures figures = Judge(rooms);
  EXPECT_EQ(figures.false_rooms, 1);
  EXPECT_EQ(figures.iou90, 3);
  EXPECT_NEAR(*figures.f1_10cm, 6.0 / 7, 1e-12);
}

TEST(EvaluateRooms, AMirroredPlanKeepsWhatIsSymmetric) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  for (Ring2& room : rooms) {
    for (Eigen::Vector2d& p : room) p.x() = 8.1 - p.x();
  }
  const RoomFigures figures = Judge(rooms);
  // The home is symmetric about x = 4.05: mirrored, its two rooms have changed places.
  EXPECT_EQ(figures.iou90, 3);
  EXPECT_NEAR(*figures.ceiling_median_m, 0.1, 1e-9);  // 0.1, 0.1 and 0
}

TEST(EvaluateRooms, CeilingsAreHeightsAboveTheFloorOfTheRoom) {
  SmallHome home = MakeSmallHome();
  for (Room& room : home.plan.storeys[0].rooms) {
    room.floor_z -= 0.5;
    room.ceiling_z -= 0.5;
  }
  home.plan.storeys[0].rooms[0].ceiling_z += 0.03;
  home.plan.storeys[0].rooms[1].ceiling_z -= 0.04;
  home.plan.storeys[0].rooms[2].ceiling_z += 0.10;
  const auto judge = [&] {
    return *EvaluateRooms(JudgedPlanOf(home.plan), JudgedPlanOf(home.truth)).ceiling_median_m;
  };
  EXPECT_NEAR(judge(), 0.04, 1e-9);
  home.truth.rooms[2].ceiling_z.reset();
  EXPECT_NEAR(judge(), 0.035, 1e-9);
}

TEST(EvaluateRooms, NoRoomsFound) {
  const RoomFigures figures = Judge({});
  EXPECT_EQ(figures.total, 3);
  EXPECT_EQ(figures.iou50, 0);
  EXPECT_EQ(figures.f1_10cm, 0.0);
  EXPECT_EQ(figures.corner_f1_10cm, 0.0);
  EXPECT_EQ(figures.ceiling_median_m, std::nullopt);
}

TEST(MatchRooms, IsOneToOneByFallingIou) {
  RoomOverlaps overlaps;
  overlaps.truth_m2 = {1, 1};
  overlaps.result_m2 = {1, 1};
  overlaps.iou = {{0.6, 0.5}, {0.7, 0.2}};
  EXPECT_THAT(MatchRooms(overlaps), ElementsAre(1, 0));
  overlaps.iou = {{0.6, 0}, {0.7, 0}};
  EXPECT_THAT(MatchRooms(overlaps), ElementsAre(-1, 0));
}

// The twin: looks through all free pairs again for each match.
std::vector<int> SlowMatches(const RoomOverlaps& overlaps) {
  std::vector<int> matches(overlaps.truth_m2.size(), -1);
  std::vector<bool> is_taken(overlaps.result_m2.size(), false);
  while (true) {
    double best = 0;
    size_t best_truth = 0, best_result = 0;
    for (size_t t = 0; t < matches.size(); ++t) {
      for (size_t r = 0; r < is_taken.size(); ++r) {
        if (matches[t] >= 0 || is_taken[r] || overlaps.iou[t][r] <= best) continue;
        best = overlaps.iou[t][r];
        best_truth = t;
        best_result = r;
      }
    }
    if (best == 0) return matches;
    matches[best_truth] = static_cast<int>(best_result);
    is_taken[best_result] = true;
  }
}

TEST(MatchRooms, AgreesWithItsBruteForceTwin) {
  std::mt19937 random(12);
  std::uniform_int_distribution<int> tenths(-4, 9);  // ties and pairs that share nothing
  for (int round = 0; round < 100; ++round) {
    RoomOverlaps overlaps;
    overlaps.truth_m2.assign(5, 1);
    overlaps.result_m2.assign(4, 1);
    for (int t = 0; t < 5; ++t) {
      overlaps.iou.emplace_back();
      for (int r = 0; r < 4; ++r) overlaps.iou.back().push_back(std::max(0, tenths(random)) / 10.0);
    }
    EXPECT_EQ(MatchRooms(overlaps), SlowMatches(overlaps));
  }
}

}  // namespace
}  // namespace enfilade
