// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/plane_cut.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "enfilade/geometry/boolean.h"
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

PlaneCutReport Cut(const EvidenceGrids& grids, const PlaneCutOptions& options = {}) {
  RunContext context(1);
  PlaneCutReport report = CutFloorplan({}, OneStorey(), {grids}, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

EvidenceGrids WithCameras(EvidenceGrids grids, const std::vector<Vector2d>& positions) {
  for (const Vector2d& position : positions)
    grids.cameras.push_back({static_cast<int>(grids.cameras.size()), position});
  return grids;
}

MultiPolygon2 Region(const PlaneCutReport& report) {
  MultiPolygon2 region;
  for (const Room& room : report.plan.storeys[0].rooms) region.push_back(room.polygon);
  return region;
}

// Points along the rings of the truth and rays over its inside, as dense everywhere.
EvidenceGrids DrawCounts(const MultiPolygon2& truth) {
  EvidenceGrids grids = DrawEvidence(truth);
  grids.mode = EvidenceMode::kCounts;
  for (size_t i = 0; i < grids.free.data().size(); ++i) {
    const bool is_face = grids.wall.data()[i] > 1.5F;
    grids.wall.data()[i] = is_face ? 40 : 0;
    grids.free.data()[i] = grids.free.data()[i] > 0 && !is_face ? 200 : 0;
  }
  return grids;
}

TEST(CutFloorplan, FindsARoomFromLogOdds) {
  const MultiPolygon2 truth = {Box(0, 0, 4, 3)};
  const PlaneCutReport report = Cut(WithCameras(DrawEvidence(truth), {{2, 1.5}}));
  EXPECT_EQ(report.outcome, PlaneCutOutcome::kFound);
  ASSERT_EQ(report.num_rooms, 1);
  EXPECT_EQ(Region(report)[0].outer.size(), 4u);
  EXPECT_GT(AreaIou(Region(report), truth), 0.97);
  EXPECT_EQ(report.plan.storeys[0].walls[0].seen, WallSeen::kSeen);
}

TEST(CutFloorplan, FindsRoomsFromCounts) {
  const MultiPolygon2 truth = {{ParseRing("0,0 5,0 5,2 2,2 2,4 0,4"), {}}, Box(2.12, 2.12, 5, 4)};
  const PlaneCutReport report = Cut(WithCameras(DrawCounts(truth), {{1, 1}, {3, 3}}));
  EXPECT_EQ(report.num_rooms, 2);
  EXPECT_GT(AreaIou(Region(report), truth), 0.95);
}

// What the paper holds against the method: one price for the whole border, so what keeps outlines
// smooth takes thin walls away.
TEST(CutFloorplan, ThinWallsVanishAtAHighLambda) {
  const MultiPolygon2 truth = {Box(0, 0, 3, 3), Box(3.12, 0, 6, 3)};
  const EvidenceGrids grids = WithCameras(DrawCounts(truth), {{1, 1}, {5, 1}});
  EXPECT_EQ(Cut(grids, {.lambda = 100}).num_rooms, 2);
  const PlaneCutReport report = Cut(grids, {.lambda = 1600});
  ASSERT_EQ(report.num_rooms, 1);
  EXPECT_TRUE(Contains(Region(report)[0], {3.06, 1.5}));
}

TEST(CutFloorplan, OnlyPartsWithACameraAreRooms) {
  const MultiPolygon2 truth = {Box(0, 0, 3, 3), Box(3.12, 0, 6, 3)};
  const PlaneCutReport report = Cut(WithCameras(DrawEvidence(truth), {{5, 1}}));
  EXPECT_EQ(report.num_parts, 2);
  ASSERT_EQ(report.num_rooms, 1);
  EXPECT_TRUE(Contains(Region(report)[0], {5, 1}));
  EXPECT_EQ(Cut(WithCameras(DrawEvidence(truth), {{-0.5, 1}})).outcome, PlaneCutOutcome::kNoRoom);
}

TEST(CutFloorplan, LargeHolesStay) {
  Polygon2 room = Box(0, 0, 5, 5);
  room.holes = {ParseRing("1,1 1,2 2,2 2,1"), ParseRing("3,3 3,3.3 3.3,3.3 3.3,3")};
  // The middle of a large pillar is as unknown as what lies beyond the walls.
  const EvidenceGrids grids = WithCameras(DrawEvidence({room}), {{0.5, 0.5}});
  const PlaneCutReport report = Cut(grids, {.min_hole_m2 = 0.25});
  ASSERT_EQ(report.num_rooms, 1);
  EXPECT_EQ(Region(report)[0].holes.size(), 1u);
  EXPECT_EQ(Region(Cut(grids, {.min_hole_m2 = 0.01}))[0].holes.size(), 2u);
}

TEST(CutFloorplan, MoreLambdaNeverLengthensTheBorder) {
  const MultiPolygon2 truth = {{ParseRing("0,0 6,0 6,3 3.5,3 3.5,5 0,5"), {}}};
  const EvidenceGrids grids =
      WithCameras(DrawEvidence(truth, {.face_blur_m = 0.04, .noise = 2}), {{1, 1}});
  double last = std::numeric_limits<double>::infinity();
  for (const double lambda : {25.0, 100.0, 400.0, 1600.0}) {
    double length = 0;
    for (const Polygon2& room : Region(Cut(grids, {.lambda = lambda, .min_hole_m2 = 0}))) {
      for (const Ring2& ring : RingsOf(room)) length += Perimeter(ring);
    }
    EXPECT_LE(length, last) << lambda;
    last = length;
  }
}

TEST(CutFloorplan, AHighLambdaLeavesNothing) {
  const EvidenceGrids grids = WithCameras(DrawCounts({Box(0, 0, 3, 3)}), {{1, 1}});
  const PlaneCutReport report = Cut(grids, {.lambda = 20000});
  EXPECT_EQ(report.outcome, PlaneCutOutcome::kNoRoom);
  EXPECT_EQ(report.reason, "the cheapest cut leaves nothing inside");
  EXPECT_TRUE(report.plan.storeys[0].rooms.empty());
}

// The evidence moved by whole cells moves the plan and changes nothing else.
TEST(CutFloorplan, MovesWithTheEvidence) {
  EvidenceGrids grids = WithCameras(
      DrawEvidence({{ParseRing("0,0 6,0 6,3 3.5,3 3.5,5 0,5"), {}}}, {.noise = 1}), {{1, 1}});
  const PlaneCutReport report = Cut(grids);
  const Vector2d shift(10 * grids.frame.cell_m, -4 * grids.frame.cell_m);
  grids.frame.origin += shift;
  grids.cameras[0].position += shift;
  const PlaneCutReport moved = Cut(grids);
  EXPECT_EQ(moved.cut_cost, report.cut_cost);
  const MultiPolygon2 rooms = Region(report), moved_rooms = Region(moved);
  ASSERT_EQ(moved_rooms.size(), rooms.size());
  for (size_t i = 0; i < rooms.size(); ++i) {
    const Ring2 &ring = rooms[i].outer, &moved_ring = moved_rooms[i].outer;
    ASSERT_EQ(moved_ring.size(), ring.size());
    for (size_t k = 0; k < ring.size(); ++k)
      EXPECT_LT((ring[k] + shift - moved_ring[k]).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace enfilade
