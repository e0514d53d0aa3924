// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/room_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "enfilade/floorplan/vertex_dial.h"
#include "enfilade/geometry/boolean.h"
#include "src/floorplan/change_sums.h"
#include "src/floorplan/micrometres.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

Structure OneStorey() {
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  return structure;
}

Floorplan PlanOf(const EvidenceGrids& grids, const std::vector<Vector2d>& cameras = {},
                 int num_threads = 2) {
  RunContext context(num_threads);
  Floorplan plan = SolveFloorplan({}, OneStorey(), {grids}, {}, context).plan;
  for (const Vector2d& camera : cameras) {
    plan.cameras.emplace_back().world_from_cam.translation = {camera.x(), camera.y(), 1.5};
  }
  for (Wall& wall : plan.storeys[0].walls) wall.sigma_m = 0.03 + 0.001 * wall.id;
  FindRoomCurves({grids}, {}, context, plan);
  ExpectValidFloorplan(plan);
  return plan;
}

const Room& FirstRoom(const Floorplan& plan) { return plan.storeys[0].rooms.at(0); }

void ExpectLaws(const Floorplan& plan) {
  for (const Room& room : plan.storeys[0].rooms) {
    SCOPED_TRACE(testing::Message() << "room " << room.id);
    ASSERT_FALSE(room.curve.empty());
    const OutlineChoice& drawn = room.curve.back();
    EXPECT_EQ(drawn.cost_m, 0);
    EXPECT_EQ(drawn.polygon.outer, ToMicrometres(room.polygon).outer);
    for (size_t i = 0; i + 1 < room.curve.size(); ++i) {
      EXPECT_LT(room.curve[i].NumVertices(), room.curve[i + 1].NumVertices());
      EXPECT_GT(room.curve[i].cost_m, room.curve[i + 1].cost_m);
    }
    for (const OutlineChoice& choice : room.curve) {
      EXPECT_EQ(choice.seen.size(), static_cast<size_t>(choice.NumVertices()));
      EXPECT_EQ(choice.sigma_m.size(), choice.seen.size());
    }
  }
}

/// Any outlines together make a valid plan.
void ExpectAllPlansValid(const Floorplan& plan) {
  std::mt19937 random(5);
  for (int round = 0; round < 30; ++round) {
    Floorplan other = plan;
    Storey& storey = other.storeys[0];
    storey.walls.clear();
    for (Room& room : storey.rooms)
      TakeOutline(room.curve[random() % room.curve.size()], 0.1, room, storey);
    ExpectValidFloorplan(other);
  }
  for (const int number : VertexNumbers(plan)) {
    const auto dialled = PlanWithVertices(plan, number, 0.45);
    ASSERT_TRUE(dialled);
    ExpectValidFloorplan(*dialled);
  }
}

TEST(RoomCurves, ANicheCostsItsFreeSpaceAndTheNewWall) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,3 3.5,3 3.5,3.4 2,3.4 2,3 0,3"), {}}};
  const Floorplan plan = PlanOf(DrawEvidence(truth), {{2, 1.5}});
  ExpectLaws(plan);
  const std::vector<OutlineChoice>& curve = FirstRoom(plan).curve;
  ASSERT_GE(curve.size(), 2U);
  EXPECT_EQ(curve[0].NumVertices(), 4);
  EXPECT_NEAR(Area(curve[0].polygon), 15, 0.05);
  // 8 a square metre of 0.6, sure to tanh(1.5), and 1.5 m.
  EXPECT_NEAR(curve[0].cost_m, 8 * 0.6 * std::tanh(1.5) + 1.5, 0.2);
  EXPECT_EQ(curve.back().NumVertices(), 8);
}

TEST(RoomCurves, DoubtfulSpaceGoesFirst) {
  const MultiPolygon2 truth = {
      {ParseRing("0,0 6,0 6,3 5,3 5,3.4 4,3.4 4,3 2,3 2,3.4 1,3.4 1,3 0,3"), {}}};
  EvidenceGrids grids = DrawEvidence(truth);
  AddEvidence(Box(4.02, 3.05, 4.98, 3.38), -2.5, 0, grids);
  EraseCore(Box(4, 3, 5, 3.4), grids);
  const Floorplan plan = PlanOf(grids, {{3, 1}});
  ExpectLaws(plan);
  const std::vector<OutlineChoice>& curve = FirstRoom(plan).curve;
  const auto eight = std::find_if(curve.begin(), curve.end(), [](const OutlineChoice& choice) {
    return choice.NumVertices() == 8;
  });
  ASSERT_NE(eight, curve.end());
  EXPECT_FALSE(Contains(eight->polygon, Vector2d(4.5, 3.2)));
  EXPECT_TRUE(Contains(eight->polygon, Vector2d(1.5, 3.2)));
}

TEST(RoomCurves, CamerasStayInside) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,3 3.5,3 3.5,4.5 2,4.5 2,3 0,3"), {}}};
  const Floorplan plan = PlanOf(DrawEvidence(truth), {{1, 1}, {2.7, 4}});
  ExpectLaws(plan);
  for (const OutlineChoice& choice : FirstRoom(plan).curve) {
    EXPECT_TRUE(Contains(choice.polygon, Vector2d(2.7, 4)));
    EXPECT_TRUE(Contains(choice.polygon, Vector2d(1, 1)));
  }
}

TEST(RoomCurves, ObliqueWallsAreInTheCurve) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,3 3.6,3 3,3.6 2,3.6 1.4,3 0,3"), {}}};
  const Floorplan plan = PlanOf(DrawEvidence(truth, {.face_blur_m = 0.025}), {{2, 1.5}});
  ExpectLaws(plan);
  const std::vector<OutlineChoice>& curve = FirstRoom(plan).curve;
  EXPECT_EQ(curve.back().NumVertices(), 8);
  EXPECT_EQ(curve.front().NumVertices(), 4);
}

TEST(RoomCurves, APillarMayBeLeftOut) {
  MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  truth[0].holes.push_back(ParseRing("2,1.5 2,2 2.5,2 2.5,1.5"));
  const Floorplan plan = PlanOf(DrawEvidence(truth), {{1, 1}});
  ExpectLaws(plan);
  const std::vector<OutlineChoice>& curve = FirstRoom(plan).curve;
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[0].NumVertices(), 4);
  EXPECT_TRUE(curve[0].polygon.holes.empty());
  EXPECT_GT(curve[0].cost_m, 0.5) << "solid wall is taken in";
}

TEST(RoomCurves, SigmaIsThatOfTheWallOnTheLine) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,3 3.5,3 3.5,3.4 2,3.4 2,3 0,3"), {}}};
  const Floorplan plan = PlanOf(DrawEvidence(truth));
  const Storey& storey = plan.storeys[0];
  const OutlineChoice& simple = FirstRoom(plan).curve[0];
  for (size_t i = 0; i < simple.polygon.outer.size(); ++i) {
    const Vector2d &a = simple.polygon.outer[i],
                   &b = simple.polygon.outer[(i + 1) % simple.polygon.outer.size()];
    const Vector2d along = (b - a).normalized();
    EXPECT_TRUE(std::any_of(storey.walls.begin(), storey.walls.end(), [&](const Wall& wall) {
      return std::abs(wall.sigma_m - simple.sigma_m[i]) < 1e-9 &&
             along.dot((wall.b - wall.a).normalized()) > 0.999 &&
             std::abs(along.x() * (wall.a - a).y() - along.y() * (wall.a - a).x()) < 1e-5;
    }));
  }
}

// Rooms whose bays point at each other, with space between that is nobody's.
MultiPolygon2 InterlockedRooms() {
  return {{ParseRing("0,0 3,0 3,1 3.6,1 3.6,2 3,2 3,4 0,4"), {}},
          {ParseRing("4.4,0 7,0 7,4 4.4,4 4.4,3.4 3.9,3.4 3.9,2.5 4.4,2.5"), {}},
          {ParseRing("0,4.2 2,4.2 2,4.6 5,4.6 5,4.2 7,4.2 7,6 0,6"), {}}};
}

TEST(RoomCurves, RoomsNeverOverlapWhateverIsChosen) {
  const Floorplan plan =
      PlanOf(DrawEvidence(InterlockedRooms()), {{1.5, 1.5}, {5.5, 1.5}, {1, 5.2}});
  ASSERT_GE(plan.storeys[0].rooms.size(), 3U);
  ExpectLaws(plan);
  ExpectAllPlansValid(plan);
  EXPECT_GT(VertexNumbers(plan).size(), 4U);
}

TEST(RoomCurves, AreTheSameForAnyNumberOfThreads) {
  const EvidenceGrids grids =
      DrawEvidence(InterlockedRooms(), {.face_blur_m = 0.04, .noise = 1, .seed = 3});
  const Floorplan one = PlanOf(grids, {}, 1), four = PlanOf(grids, {}, 4);
  ASSERT_EQ(one.storeys[0].rooms.size(), four.storeys[0].rooms.size());
  ExpectLaws(one);
  ExpectAllPlansValid(one);
  for (size_t r = 0; r < one.storeys[0].rooms.size(); ++r) {
    const std::vector<OutlineChoice>&a = one.storeys[0].rooms[r].curve,
          &b = four.storeys[0].rooms[r].curve;
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].cost_m, b[i].cost_m);
      EXPECT_EQ(a[i].polygon.outer, b[i].polygon.outer);
    }
  }
}

TEST(RoomCurves, WithoutRoomsOrEvidenceThereIsNothingToDo) {
  RunContext context(1);
  Floorplan none;
  none.storeys.emplace_back();
  FindRoomCurves({EvidenceGrids{}}, {}, context, none);
  EXPECT_TRUE(VertexNumbers(none).empty());
}

TEST(ChangeSums, AreExactForWalksAlongTheAxes) {
  LoopField field;
  field.frame = {{-1, -1}, 0.1, 30, 40};
  field.freeness = ImageF(30, 40);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-1, 1);
  for (float& cell : field.freeness.data()) cell = any(random);
  ImageU8 foreign(20, 30);
  for (uint8_t& cell : foreign.data()) cell = random() % 5 == 0;
  const EvidenceSums sums(field, 5, 5, foreign);
  const Ring2 ring = ParseRing("0.03,-0.22 1.47,-0.22 1.47,0.61 0.9,0.61 0.9,1.13 0.03,1.13");
  EXPECT_TRUE(sums.Covers(ring));
  EXPECT_FALSE(sums.Covers(ParseRing("0,0 1,0 1,1.6 0,1.6")));
  double free = 0, solid = 0, of_others = 0;
  for (int row = 0; row < 20; ++row) {
    for (int col = 0; col < 30; ++col) {
      const Vector2d low = field.frame.Center(row + 5, col + 5) - Vector2d(0.05, 0.05);
      const double area =
          Area(Intersection({{ring, {}}}, {Box(low.x(), low.y(), low.x() + 0.1, low.y() + 0.1)}));
      const double freeness = field.freeness(row + 5, col + 5);
      free += area * std::max(freeness, 0.0);
      solid += area * std::max(-freeness, 0.0);
      of_others += area * foreign(row, col);
    }
  }
  const ChangeSums added = sums.Measure(ring);
  EXPECT_NEAR(added.solid_gained_m2, solid, 1e-6);
  EXPECT_NEAR(added.foreign_gained_m2, of_others, 1e-6);
  EXPECT_EQ(added.free_lost_m2, 0);
  const ChangeSums taken = sums.Measure(Ring2(ring.rbegin(), ring.rend()));
  EXPECT_NEAR(taken.free_lost_m2, free, 1e-6);
  EXPECT_EQ(taken.solid_gained_m2, 0);
  EXPECT_EQ(taken.foreign_gained_m2, 0);
}

}  // namespace
}  // namespace enfilade
