// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/solve.h"

#include <gtest/gtest.h>

#include "enfilade/geometry/boolean.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/solve_drawn.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

Structure OneStorey() {
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  return structure;
}

/// Expects the plan's faces within `tolerance_m` of the true ones, both ways, and the same number
/// of corners.
void ExpectPlan(const FloorplanReport& report, const MultiPolygon2& truth, double tolerance_m) {
  const MultiPolygon2 region = RoomsOf(report.plan);
  ASSERT_EQ(region.size(), truth.size());
  double perimeter = 0;
  for (const Polygon2& polygon : truth) {
    perimeter += Perimeter(polygon.outer);
    for (const Ring2& hole : polygon.holes) perimeter += Perimeter(hole);
  }
  const double wrong = Area(Difference(region, truth)) + Area(Difference(truth, region));
  EXPECT_LT(wrong, perimeter * tolerance_m);
  const auto count = [](const MultiPolygon2& polygons) {
    size_t corners = 0;
    for (const Polygon2& polygon : polygons) {
      corners += polygon.outer.size();
      for (const Ring2& hole : polygon.holes) corners += hole.size();
    }
    return corners;
  };
  EXPECT_EQ(count(region), count(truth));
}

TEST(SolveFloorplan, ARoomIsDrawnAsIfItWereAlone) {
  const Polygon2 room = {ParseRing("0,0 4,0 4,3 2.5,3 2.5,2 0,2"),
                         {ParseRing("1,0.6 1,1.1 1.5,1.1 1.5,0.6")}};
  const DrawOptions options = {.face_blur_m = 0.03, .noise = 0};
  const MultiPolygon2 alone = RoomsOf(SolveDrawn(DrawEvidence({room}, options)).plan);
  const MultiPolygon2 beside =
      RoomsOf(SolveDrawn(DrawEvidence({room, Box(9, 0, 13, 8)}, options)).plan);
  ASSERT_EQ(alone.size(), 1u);
  ASSERT_EQ(beside.size(), 2u);
  const Polygon2& same = beside[Contains(beside[0], {0.5, 0.5}) ? 0 : 1];
  EXPECT_EQ(same.outer, alone[0].outer);
  EXPECT_EQ(same.holes, alone[0].holes);
}

TEST(SolveFloorplan, ARectangleIsExact) {
  const MultiPolygon2 truth = {Box(0, 0, 4, 3)};
  const FloorplanReport report = SolveDrawn(DrawEvidence(truth));
  EXPECT_EQ(report.outcome, FloorplanOutcome::kFound);
  ExpectPlan(report, truth, 0.003);
  for (const Wall& wall : report.plan.storeys[0].walls) EXPECT_EQ(wall.seen, WallSeen::kSeen);
}

TEST(SolveFloorplan, WallsBetweenCellBordersAreFoundByTheSlide) {
  const MultiPolygon2 truth = {Box(0.007, -0.011, 4.013, 3.009)};
  ExpectPlan(SolveDrawn(DrawEvidence(truth, {.face_blur_m = 0.03})), truth, 0.005);
}

TEST(SolveFloorplan, AnLShapeKeepsItsCorners) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,2 2,2 2,4 0,4"), {}}};
  ExpectPlan(SolveDrawn(DrawEvidence(truth)), truth, 0.003);
}

TEST(SolveFloorplan, NoiseAndBlurMoveWallsByLittle) {
  const MultiPolygon2 truth = {{ParseRing("0,0 6,0 6,3 3.5,3 3.5,5 0,5"), {}}};
  for (uint32_t seed = 0; seed < 5; ++seed) {
    ExpectPlan(SolveDrawn(DrawEvidence(truth, {.face_blur_m = 0.04, .noise = 1, .seed = seed})),
               truth, 0.015);
  }
}

TEST(SolveFloorplan, UnseenStretchesAreBridgedStraight) {
  const MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  EvidenceGrids grids = DrawEvidence(truth);
  EraseEvidence(Box(1.5, 3.8, 3, 4.5), grids);
  const FloorplanReport report = SolveDrawn(grids);
  ExpectPlan(report, truth, 0.005);
  EXPECT_EQ(report.plan.storeys[0].walls.size(), 4u);
}

TEST(SolveFloorplan, AnUnseenWallIsSaidToBeInferred) {
  const MultiPolygon2 truth = {Box(0, 0, 4, 3)};
  EvidenceGrids grids = DrawEvidence(truth);
  EraseEvidence(Box(3.9, 0.1, 4.5, 2.9), grids);
  const FloorplanReport report = SolveDrawn(grids);
  ASSERT_EQ(report.plan.storeys[0].walls.size(), 4u);
  int num_inferred = 0;
  for (const Wall& wall : report.plan.storeys[0].walls)
    num_inferred += wall.seen == WallSeen::kInferred;
  EXPECT_EQ(num_inferred, 1);
}

TEST(SolveFloorplan, RoomsBehindOpenDoorsAreEntered) {
  // Two rooms, a wall of 10 cm with a door of 80 cm.
  const MultiPolygon2 truth = Union({Box(0, 0, 3, 4), Box(3.1, 0, 6, 4), Box(2.9, 1.5, 3.2, 2.3)});
  ExpectPlan(SolveDrawn(DrawEvidence(truth)), truth, 0.005);
}

TEST(SolveFloorplan, AThinWallFromTheOutsideIsFollowedOnBothSides) {
  const MultiPolygon2 truth = {{ParseRing("0,0 2.5,0 2.5,2 2.6,2 2.6,0 5,0 5,4 0,4"), {}}};
  const FloorplanReport report = SolveDrawn(DrawEvidence(truth));
  EXPECT_EQ(report.num_inner_walls, 1);
  ExpectPlan(report, truth, 0.005);
}

TEST(SolveFloorplan, ABlurredThinWallIsFollowedThoughItsFacesMelt) {
  const MultiPolygon2 truth = {{ParseRing("0,0 2.5,0 2.5,2 2.6,2 2.6,0 5,0 5,4 0,4"), {}}};
  const FloorplanReport report =
      SolveDrawn(DrawEvidence(truth, {.face_blur_m = 0.08, .core_distance_m = 0.2}));
  EXPECT_EQ(report.num_inner_walls, 1);
  ExpectPlan(report, truth, 0.03);
}

TEST(SolveFloorplan, AStubOfAWallBesideAWideOpeningIsFollowedToo) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,3 2.6,3 2.6,2.72 2.5,2.72 2.5,3 0,3"), {}}};
  ExpectPlan(SolveDrawn(DrawEvidence(truth)), truth, 0.005);
}

TEST(SolveFloorplan, APillarIsAHole) {
  MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  truth[0].holes.push_back(ParseRing("2,1.5 2,2 2.5,2 2.5,1.5"));
  const FloorplanReport report = SolveDrawn(DrawEvidence(truth));
  EXPECT_EQ(report.num_inner_loops, 1);
  ExpectPlan(report, truth, 0.005);
}

TEST(SolveFloorplan, AWallBetweenTwoDoorsIsAHole) {
  const MultiPolygon2 truth = Difference({Box(0, 0, 6, 4)}, {Box(3, 0.9, 3.1, 3.1)});
  const FloorplanReport report = SolveDrawn(DrawEvidence(truth));
  EXPECT_EQ(report.num_inner_loops, 1);
  ExpectPlan(report, truth, 0.005);
}

TEST(SolveFloorplan, RoomsBehindClosedDoorsStayApart) {
  const MultiPolygon2 truth = {Box(0, 0, 3, 4), Box(3.1, 0, 6, 4), Box(0, 4.1, 6, 6)};
  const FloorplanReport report = SolveDrawn(DrawEvidence(truth));
  EXPECT_EQ(report.plan.storeys[0].rooms.size(), 3u);
  ExpectPlan(report, truth, 0.005);
}

TEST(SolveFloorplan, AnErrorInsideTheRoomIsNoWall) {
  const MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  EvidenceGrids grids = DrawEvidence(truth);
  AddEvidence(Box(2, 2, 2.1, 2.1), -6, 6, grids);
  ExpectPlan(SolveDrawn(grids), truth, 0.005);
}

// A panorama that looks along the wall supposes that it goes on across the alcove; the others look
// through. Nobody stands in the alcove.
TEST(SolveFloorplan, AFaceAcrossFreeSpaceClosesNoAlcove) {
  const MultiPolygon2 truth = {
      {{{0, 0}, {5, 0}, {5, 4}, {3, 4}, {3, 6.5}, {0.5, 6.5}, {0.5, 4}, {0, 4}}, {}}};
  EvidenceGrids grids = DrawEvidence(truth, {.log_odds = 2});
  for (int row = grids.frame.Row(3.9); row < grids.frame.rows; ++row)
    std::fill_n(grids.core.row(row), grids.frame.cols, uint16_t{0});
  AddEvidence(Box(0.55, 4, 2.95, 4.03), 0, 3, grids);
  ExpectPlan(SolveDrawn(grids), truth, 0.005);
}

TEST(SolveFloorplan, ALeakBehindTheWallIsLeftOut) {
  const MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  EvidenceGrids grids = DrawEvidence(truth, {.margin_m = 3});
  AddEvidence(Box(5.15, 1, 7, 2), 2, 0, grids);  // seen through a window
  ExpectPlan(SolveDrawn(grids), truth, 0.005);
}

TEST(SolveFloorplan, HeightsAreWeightedMediansOfTheCamerasInside) {
  const MultiPolygon2 truth = {Box(0, 0, 3, 4), Box(3.1, 0, 6, 4)};
  Scene scene;
  Structure structure = OneStorey();
  const double ceilings[] = {2.3, 2.35, 3.9, 2.6};
  const double weights[] = {1, 1, 0.1, 1};
  for (int i = 0; i < 4; ++i) {
    View view;
    view.world_from_cam.translation = {i < 3 ? 1.0 + 0.3 * i : 5.0, 2, 1.5};
    scene.views.push_back(view);
    WallProfile profile;
    profile.view_idx = i;
    profile.floor_z = 0.01 * i;
    profile.ceiling_z = ceilings[i];
    profile.ceiling_weight = weights[i];
    structure.profiles.push_back(profile);
  }
  RunContext context(1);
  const FloorplanReport report =
      SolveFloorplan(scene, structure, {DrawEvidence(truth)}, {}, context);
  ExpectValidFloorplan(report.plan);
  ASSERT_EQ(report.plan.storeys[0].rooms.size(), 2u);
  for (const Room& room : report.plan.storeys[0].rooms) {
    const bool is_left = Contains(room.polygon, {1, 2});
    EXPECT_DOUBLE_EQ(room.ceiling_z, is_left ? 2.35 : 2.6);
    EXPECT_DOUBLE_EQ(room.floor_z, is_left ? 0.01 : 0.03);
  }
  EXPECT_EQ(report.plan.cameras.size(), 4u);
}

TEST(SolveFloorplan, NothingIsAnAnswer) {
  EvidenceGrids grids = DrawEvidence({Box(0, 0, 1, 1)}, {.core_distance_m = 2});
  const FloorplanReport report = SolveDrawn(grids);
  EXPECT_EQ(report.outcome, FloorplanOutcome::kNoCore);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_EQ(report.plan.storeys.size(), 1u);
}

TEST(SolveFloorplan, ShiftedEvidenceGivesAShiftedPlan) {
  EvidenceGrids grids =
      DrawEvidence({{ParseRing("0,0 5,0 5,2 2,2 2,4 0,4"), {}}}, {.face_blur_m = 0.03, .noise = 1});
  const MultiPolygon2 here = RoomsOf(SolveDrawn(grids).plan);
  grids.frame.origin += Eigen::Vector2d(100, -50);
  const MultiPolygon2 there = RoomsOf(SolveDrawn(grids).plan);
  ASSERT_EQ(here.size(), 1u);
  ASSERT_EQ(here[0].outer.size(), there[0].outer.size());
  for (size_t i = 0; i < here[0].outer.size(); ++i) {
    EXPECT_LT((there[0].outer[i] - here[0].outer[i] - Eigen::Vector2d(100, -50)).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace enfilade
