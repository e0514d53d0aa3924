// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The paper's method on drawn raw counts whose best plan is known.
#include "enfilade/floorplan/paper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/vertex_dial.h"
#include "enfilade/geometry/boolean.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/solve_drawn.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

FloorplanOptions Paper(bool use_anchors = true) {
  FloorplanOptions options;
  options.mode = FloorplanMode::kPaper;
  options.paper.use_anchors = use_anchors;
  return options;
}

FloorplanReport Solve(const EvidenceGrids& grids, const FloorplanOptions& options = Paper(),
                      int num_threads = 2) {
  return SolveDrawn(grids, options, num_threads);
}

double WrongArea(const Floorplan& plan, const MultiPolygon2& truth) {
  const MultiPolygon2 region = RoomsOf(plan);
  return Area(Difference(region, truth)) + Area(Difference(truth, region));
}

// The outline may run on either side of the cells where its wall was seen.
double GridTolerance(const MultiPolygon2& truth) {
  double perimeter = 0;
  for (const Polygon2& polygon : truth) perimeter += Perimeter(polygon.outer);
  return 0.026 * perimeter;
}

const std::vector<OutlineChoice>& Curve(const FloorplanReport& report) {
  return report.plan.storeys[0].rooms.at(0).curve;
}

void ExpectEveryEvenNumberFromFour(const FloorplanReport& report) {
  const std::vector<OutlineChoice>& curve = Curve(report);
  ASSERT_FALSE(curve.empty());
  const size_t chosen = report.plan.storeys[0].rooms[0].polygon.outer.size();
  for (size_t i = 0; i < curve.size(); ++i) {
    EXPECT_TRUE(IsSimple(curve[i].polygon.outer));
    const size_t number = 4 + 2 * i;
    if (number <= chosen) {
      EXPECT_EQ(curve[i].polygon.outer.size(), number);
    }
  }
  EXPECT_GE(curve.back().polygon.outer.size(), chosen);
}

TEST(PaperFloorplan, ARectangleHasFourWalls) {
  const MultiPolygon2 truth = {Box(0, 0, 4, 3)};
  const FloorplanReport report = Solve(DrawCounts(truth, {{2, 1.5}}));
  EXPECT_EQ(report.outcome, FloorplanOutcome::kFound);
  EXPECT_LT(WrongArea(report.plan, truth), GridTolerance(truth));
  ASSERT_EQ(report.plan.storeys[0].walls.size(), 4u);
  for (const Wall& wall : report.plan.storeys[0].walls) EXPECT_EQ(wall.seen, WallSeen::kSeen);
  ASSERT_EQ(report.paper.size(), 1u);
  ASSERT_EQ(report.paper[0].loops.size(), 1u);
  EXPECT_GE(report.paper[0].loops[0].anchors.size(), 4u);
}

TEST(PaperFloorplan, AnchorsLieOnTheFaceOfTheWall) {
  const MultiPolygon2 truth = {Box(0, 0, 4, 3)};
  const FloorplanReport report = Solve(DrawCounts(truth, {{2, 1.5}}));
  for (const PaperAnchor& anchor : report.paper[0].loops[0].anchors) {
    EXPECT_LT(DistanceToRing(truth[0].outer, anchor.position), 0.001);
    const Eigen::Vector2d into_room(-anchor.direction.y(), anchor.direction.x());
    EXPECT_TRUE(Contains(truth[0], Eigen::Vector2d(anchor.position + 0.1 * into_room)));
  }
  EXPECT_LT(WrongArea(report.plan, truth), 0.01) << "with an anchor on each wall the plan is exact";
}

TEST(PaperFloorplan, UnseenStretchesAreBridgedStraight) {
  const MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  EvidenceGrids grids = DrawCounts(truth, {{2, 1.5}});
  EraseEvidence(Box(1.5, 3.94, 3, 4.5), grids);
  const FloorplanReport report = Solve(grids);
  EXPECT_LT(WrongArea(report.plan, truth), GridTolerance(truth));
  EXPECT_EQ(report.plan.storeys[0].walls.size(), 4u);
}

TEST(PaperFloorplan, TheCutLeadsFromTheCoreToTheFirstPath) {
  const FloorplanReport report = Solve(DrawCounts({Box(0, 0, 4, 3)}, {{2, 1.5}}));
  const PaperLoop& loop = report.paper[0].loops[0];
  EXPECT_TRUE(Contains(Polygon2{loop.first_path, {}}, loop.cut[0]));
  EXPECT_LT(DistanceToRing(loop.first_path, loop.cut[1]), 1e-9);
}

// 0.4 m wide: following it costs four corners more, 0.5 m, than its mouth.
const MultiPolygon2& RoomWithAlcove() {
  static const MultiPolygon2 kRoom = {{ParseRing("0,0 5,0 5,4 3,4 3,5 2.6,5 2.6,4 0,4"), {}}};
  return kRoom;
}

EvidenceGrids CountsOfAlcove() {
  EvidenceGrids grids = DrawCounts(RoomWithAlcove(), {{2.8, 1}});
  EraseCore(Box(0, 3.92, 5, 6), grids);
  return grids;
}

TEST(PaperFloorplan, TheFirstPathShrinksAndAnchorsUndoIt) {
  const FloorplanReport shrunk = Solve(CountsOfAlcove(), Paper(false));
  EXPECT_EQ(shrunk.plan.storeys[0].walls.size(), 4u);
  EXPECT_LT(WrongArea(shrunk.plan, {Box(0, 0, 5, 4)}), GridTolerance({Box(0, 0, 5, 4)}));
  const FloorplanReport report = Solve(CountsOfAlcove());
  EXPECT_EQ(report.plan.storeys[0].walls.size(), 8u);
  EXPECT_LT(WrongArea(report.plan, RoomWithAlcove()), 0.05);
}

// Two rooms, a wall of 10 cm with a door of 0.45 m, which the first path closes.
MultiPolygon2 RoomsWithDoor() {
  return Union({Box(0, 0, 3, 4), Box(3.1, 0, 6, 4), Box(2.9, 1.5, 3.2, 1.95)});
}

TEST(PaperFloorplan, ARoomBehindADoorThatWasSeenForSureBecomesCore) {
  EvidenceGrids grids = DrawCounts(RoomsWithDoor(), {{1, 1.7}, {1, 3}});
  EraseCore(Box(2.95, 0, 7, 5), grids);
  for (const bool use_anchors : {true, false}) {
    const FloorplanReport report = Solve(grids, Paper(use_anchors));
    EXPECT_EQ(report.plan.storeys[0].rooms.size(), 1u);
    // Without anchors jambs are cut, as the wall is thinner than corners are dear.
    EXPECT_LT(WrongArea(report.plan, RoomsWithDoor()),
              use_anchors ? 0.45 : 0.45 + GridTolerance(RoomsWithDoor()));
  }
}

TEST(PaperFloorplan, ARoomThatWasGlimpsedThroughADoorIsEnteredByAnchors) {
  EvidenceGrids grids = DrawCounts(RoomsWithDoor(), {{1, 1.7}, {2.5, 1.72}});
  EraseCore(Box(2.95, 0, 7, 5), grids);
  for (int row = 0; row < grids.frame.rows; ++row) {
    for (int col = grids.frame.Col(3); col < grids.frame.cols; ++col) grids.support(row, col) = 0;
  }
  const double closed = WrongArea(Solve(grids, Paper(false)).plan, RoomsWithDoor());
  const double open = WrongArea(Solve(grids).plan, RoomsWithDoor());
  EXPECT_GT(closed, 11);
  EXPECT_LT(open, 0.45);
}

TEST(PaperFloorplan, CoresThatCamerasSeeEachOtherThroughHaveOneLoop) {
  EvidenceGrids grids = DrawCounts(RoomsWithDoor(), {{1, 1.7}, {5, 1.7}});
  EraseCore(Box(2.8, 0, 3.3, 5), grids);
  for (int row = 0; row < grids.frame.rows; ++row) {
    for (int col = grids.frame.Col(3); col < grids.frame.cols; ++col) {
      if (grids.core(row, col) != 0) grids.core(row, col) = 2;
    }
  }
  grids.num_cores = 2;
  FloorplanReport report = Solve(grids);
  EXPECT_EQ(report.num_cores, 1);
  EXPECT_EQ(report.plan.storeys[0].rooms.size(), 1u);
  EXPECT_LT(WrongArea(report.plan, RoomsWithDoor()), 0.45);
  // With the cameras where the wall parts them, there are two rooms that do not overlap.
  grids.cameras = {{0, {1, 3}}, {1, {5, 3}}};
  report = Solve(grids);
  EXPECT_EQ(report.plan.storeys[0].rooms.size(), 2u);
}

TEST(PaperFloorplan, RoomsBehindClosedDoorsStayApart) {
  const MultiPolygon2 truth = {Box(0, 0, 3, 4), Box(3.1, 0, 6, 4), Box(0, 4.1, 6, 6)};
  const FloorplanReport report = Solve(DrawCounts(truth, {{1, 1}, {5, 1}, {3, 5}}));
  EXPECT_EQ(report.plan.storeys[0].rooms.size(), 3u);
  EXPECT_LT(WrongArea(report.plan, truth), GridTolerance(truth));
}

TEST(PaperFloorplan, AFalseWallBehindTheTrueOneIsRefused) {
  const MultiPolygon2 truth = {Box(0, 0, 5, 4)};
  EvidenceGrids grids = DrawCounts(truth, {{2, 1.5}}, {.margin_m = 3});
  // One camera's columns ran through a hole in the wall's evidence, to clutter 2 m behind it.
  EraseEvidence(Box(2, 3.9, 2.4, 4.1), grids);
  AddEvidence(Box(2, 3.9, 2.4, 5.9), 5, 0, grids);
  AddEvidence(Box(2, 6, 2.4, 6.025), 0, 9, grids);
  const FloorplanReport report = Solve(grids);
  EXPECT_GE(report.paper[0].loops[0].num_anchors_refused, 1);
  EXPECT_LT(WrongArea(report.plan, truth), GridTolerance(truth));
}

TEST(PaperCurve, WithoutAnchorsItsLeastTotalIsTheFirstPath) {
  const MultiPolygon2 rooms[] = {{Box(0, 0, 4, 3)},
                                 {{ParseRing("0,0 5,0 5,2 2,2 2,4 0,4"), {}}},
                                 RoomWithAlcove(),
                                 RoomsWithDoor()};
  for (const MultiPolygon2& truth : rooms) {
    EvidenceGrids grids = DrawCounts(truth, {{1, 1}});
    EraseEvidence(Box(0.5, -0.1, 1.2, 0.04), grids);
    const FloorplanOptions options = Paper(false);
    const FloorplanReport report = Solve(grids, options);
    const std::vector<OutlineChoice>& curve = Curve(report);
    ExpectEveryEvenNumberFromFour(report);
    double least = std::numeric_limits<double>::infinity();
    for (const OutlineChoice& choice : curve)
      least = std::min(least, choice.cost_m + options.paper.alpha_m * choice.NumVertices());
    EXPECT_NEAR(least, report.paper[0].loops[0].first_cost_m, 1e-9);
  }
}

TEST(PaperCurve, WithAnchorsItStillStartsAtFour) {
  const FloorplanReport report = Solve(CountsOfAlcove());
  ExpectEveryEvenNumberFromFour(report);
  EXPECT_NEAR(Area(Curve(report)[0].polygon), 20, 0.6);  // the room without its alcove
  for (const OutlineChoice& choice : Curve(report)) {
    EXPECT_EQ(choice.seen.size(), static_cast<size_t>(choice.NumVertices()));
    EXPECT_EQ(choice.sigma_m.size(), choice.seen.size());
  }
}

TEST(PaperCurve, TheNumberOfCornersCanBeChosen) {
  FloorplanReport report = Solve(CountsOfAlcove(), Paper());
  const FloorplanOptions options;
  const auto dialled = PlanWithVertices(report.plan, 4, options.openings.max_wall_m);
  ASSERT_TRUE(dialled);
  EXPECT_EQ(dialled->storeys[0].walls.size(), 4u);
  report.plan = *dialled;
  ExpectEveryEvenNumberFromFour(report);
  EXPECT_FALSE(PlanWithVertices(report.plan, 5, options.openings.max_wall_m));
}

TEST(PaperFloorplan, NothingIsAnAnswer) {
  const FloorplanReport report =
      Solve(DrawCounts({Box(0, 0, 1, 1)}, {{0.5, 0.5}}, {.core_distance_m = 2}));
  EXPECT_EQ(report.outcome, FloorplanOutcome::kNoCore);
  EXPECT_FALSE(report.reason.empty());
  EvidenceGrids empty;
  empty.mode = EvidenceMode::kCounts;
  EXPECT_EQ(Solve(empty).outcome, FloorplanOutcome::kNoCore);
}

TEST(PaperFloorplan, WithoutAnyWallTheCoreIsTheRoom) {
  EvidenceGrids grids = DrawCounts({Box(0, 0, 4, 3)}, {{2, 1.5}});
  std::fill(grids.wall.data().begin(), grids.wall.data().end(), 0.0F);
  std::fill(grids.free.data().begin(), grids.free.data().end(), 0.0F);
  const FloorplanReport report = Solve(grids);
  EXPECT_EQ(report.outcome, FloorplanOutcome::kFound);
  EXPECT_NEAR(Area(RoomsOf(report.plan)), 3.8 * 2.8, 0.1);
}

TEST(PaperFloorplan, CellsThatAreNoNumbersCountAsNone) {
  const MultiPolygon2 truth = {Box(0, 0, 4, 3)};
  EvidenceGrids grids = DrawCounts(truth, {{2, 1.5}});
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(), -5};
  for (int k = 0; k < 60; ++k) {
    grids.wall(10 + k, 40) = bad[k % 3];
    grids.free(10 + k, 90) = bad[k % 3];
  }
  EXPECT_LT(WrongArea(Solve(grids).plan, truth), GridTolerance(truth));
}

TEST(PaperFloorplan, ACoreAtTheBorderOfTheGridHasALoop) {
  // The grid ends within the room: 1 m short of its faces.
  EvidenceGrids grids = DrawCounts({Box(0, 0, 4, 3)}, {{2, 1.5}}, {.margin_m = -1});
  for (int row = 0; row < grids.frame.rows; ++row) {
    for (int col = 0; col < grids.frame.cols; ++col) grids.core(row, col) = 1;
  }
  grids.num_cores = 1;
  const FloorplanReport report = Solve(grids);
  EXPECT_EQ(report.outcome, FloorplanOutcome::kFound);
  EXPECT_NEAR(Area(RoomsOf(report.plan)), 2, 0.2);
}

TEST(PaperFloorplan, TheSamePlanForAnyNumberOfThreads) {
  const MultiPolygon2 truth = {Box(0, 0, 3, 4), Box(3.1, 0, 6, 4), Box(0, 4.1, 6, 6)};
  const EvidenceGrids grids = DrawCounts(truth, {{1, 1}, {5, 1}, {3, 5}});
  const MultiPolygon2 one = RoomsOf(Solve(grids, Paper(), 1).plan);
  const MultiPolygon2 three = RoomsOf(Solve(grids, Paper(), 3).plan);
  ASSERT_EQ(one.size(), three.size());
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].outer, three[i].outer);
}

TEST(PaperFloorplan, ShiftedAndTurnedEvidenceGivesAShiftedAndTurnedPlan) {
  EvidenceGrids grids = CountsOfAlcove();
  const double here = Area(RoomsOf(Solve(grids).plan));
  EvidenceGrids turned = grids;
  std::swap(turned.frame.rows, turned.frame.cols);
  const auto turn = [&](auto& image) {
    auto copy = image;
    image = std::decay_t<decltype(image)>(turned.frame.rows, turned.frame.cols);
    for (int row = 0; row < copy.rows(); ++row) {
      for (int col = 0; col < copy.cols(); ++col)
        image(col, copy.rows() - 1 - row) = copy(row, col);
    }
  };
  turn(turned.wall);
  turn(turned.free);
  turn(turned.support);
  turn(turned.core);
  const double width = grids.frame.rows * grids.frame.cell_m;
  for (EvidenceCamera& camera : turned.cameras) {
    const Eigen::Vector2d p = camera.position - grids.frame.origin;
    camera.position = grids.frame.origin + Eigen::Vector2d(width - p.y(), p.x());
  }
  const FloorplanReport report = Solve(turned);
  EXPECT_NEAR(Area(RoomsOf(report.plan)), here, 0.15);
  EXPECT_EQ(report.plan.storeys[0].walls.size(), 8u);
}

}  // namespace
}  // namespace enfilade
