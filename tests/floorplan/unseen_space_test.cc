// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/boolean.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

FloorplanReport Solve(const EvidenceGrids& grids, const FloorplanOptions& options = {}) {
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  RunContext context(2);
  FloorplanReport report = SolveFloorplan({}, structure, {grids}, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

FloorplanReport Solve(const MultiPolygon2& seen, const FloorplanOptions& options = {}) {
  return Solve(DrawEvidence(seen), options);
}

MultiPolygon2 Region(const FloorplanReport& report) {
  MultiPolygon2 region;
  for (const Room& room : report.plan.storeys[0].rooms) region.push_back(room.polygon);
  return region;
}

/// Expects these rooms, whatever their order: four corners where the true room has four.
void ExpectRooms(const FloorplanReport& report, const MultiPolygon2& truth,
                 double tolerance_m2 = 0.1) {
  const MultiPolygon2 rooms = Region(report);
  ASSERT_EQ(rooms.size(), truth.size());
  for (const Polygon2& expected : truth) {
    const auto found = std::find_if(rooms.begin(), rooms.end(), [&](const Polygon2& room) {
      return Area(Difference({room}, {expected})) + Area(Difference({expected}, {room})) <
             tolerance_m2;
    });
    ASSERT_NE(found, rooms.end()) << "no room with corner " << expected.outer[0].transpose();
    EXPECT_EQ(found->outer.size(), expected.outer.size());
  }
}

int NumInferred(const FloorplanReport& report) {
  const std::vector<Wall>& walls = report.plan.storeys[0].walls;
  return static_cast<int>(std::count_if(walls.begin(), walls.end(), [](const Wall& wall) {
    return wall.seen == WallSeen::kInferred;
  }));
}

TEST(UnseenSpace, ACupboardFrontInARoomIsPassed) {
  // A wardrobe, 0.6 m deep, along half of a wall that is 0.1 m thick.
  const MultiPolygon2 seen = {{ParseRing("0,0 4,0 4,3 2,3 2,2.4 0,2.4"), {}}, Box(0, 3.1, 4, 6)};
  const FloorplanReport report = Solve(seen);
  ExpectRooms(report, {Box(0, 0, 4, 3), Box(0, 3.1, 4, 6)});
  EXPECT_NEAR(report.unseen_m2, 1.2, 0.1);
}

TEST(UnseenSpace, ShallowSpaceBetweenTwoRoomsGoesToOneOfThem) {
  const FloorplanReport report = Solve({Box(0, 0, 4, 3), Box(0, 3.7, 4, 7)});
  EXPECT_EQ(report.plan.storeys[0].rooms.size(), 2u);
  EXPECT_NEAR(report.unseen_m2, 4 * 0.58, 0.1);
  EXPECT_EQ(report.plan.storeys[0].walls.size(), 8u);
  EXPECT_EQ(NumInferred(report), 1);
}

TEST(UnseenSpace, DeepSpaceIsARoomOfItsOwnThatNobodySaw) {
  const FloorplanReport report = Solve({Box(0, 0, 4, 3), Box(0, 4.4, 4, 7)});
  ExpectRooms(report, {Box(0, 0, 4, 3), Box(0, 3.12, 4, 4.28), Box(0, 4.4, 4, 7)});
  EXPECT_EQ(NumInferred(report), 4);
}

TEST(UnseenSpace, WallsAndOpenAirStay) {
  for (const double gap_m : {0.1, 0.3, 1.8, 3.0}) {
    SCOPED_TRACE(gap_m);
    const MultiPolygon2 seen = {Box(0, 0, 4, 3), Box(0, 3 + gap_m, 4, 6 + gap_m)};
    const FloorplanReport report = Solve(seen);
    ExpectRooms(report, seen);
    EXPECT_EQ(report.unseen_m2, 0);
  }
}

TEST(UnseenSpace, WhatOneRoomShowsAllRoundStays) {
  // A chimney breast, a column in a corner and one that stands free.
  const MultiPolygon2 seen =
      Difference({{ParseRing("0,0 6,0 6,4 3.5,4 3.5,3.5 2.2,3.5 2.2,4 0.4,4 0.4,3.6 0,3.6"), {}}},
                 {Box(2, 1.5, 2.6, 2.1)});
  const FloorplanReport report = Solve(seen);
  ExpectRooms(report, seen);
  EXPECT_EQ(report.plan.storeys[0].rooms[0].polygon.holes.size(), 1u);
}

TEST(UnseenSpace, ARoomThatWasCutOffGoesOn) {
  // Of a hall between two rooms only the near half was seen, and no wall at its end.
  EvidenceGrids grids = DrawEvidence({Box(0, 0, 6, 3), Box(0, 3.1, 3, 4.3), Box(0, 4.4, 6, 7)});
  EraseEvidence(Box(2.9, 3.05, 3.3, 4.35), grids);
  const FloorplanReport report = Solve(grids);
  ExpectRooms(report, {Box(0, 0, 6, 3), Box(0, 3.1, 6, 4.3), Box(0, 4.4, 6, 7)}, 0.15);
}

TEST(UnseenSpace, AHoleAmongRoomsBelongsToTheHomeUnlessItIsLarge) {
  // Four rooms round a space of 1.8 m × 1.8 m, or of 3 m × 3 m.
  for (const double size_m : {1.7, 2.9}) {
    SCOPED_TRACE(size_m);
    const double end_m = 2 + size_m;
    const FloorplanReport report =
        Solve({Box(0, 0, end_m, 2), Box(end_m + 0.1, 0, end_m + 2, end_m),
               Box(2, end_m + 0.1, end_m + 2, end_m + 2), Box(0, 2.1, 1.9, end_m + 2)});
    EXPECT_EQ(report.plan.storeys[0].rooms.size(), size_m < 2 ? 5u : 4u);
    EXPECT_EQ(report.unseen_m2 > 0, size_m < 2);
  }
}

TEST(UnseenSpace, CanBeLeftOut) {
  const MultiPolygon2 seen = {Box(0, 0, 4, 3), Box(0, 4.4, 4, 7)};
  FloorplanOptions options;
  options.unseen_gap_m = 0;
  const FloorplanReport report = Solve(seen, options);
  ExpectRooms(report, seen);
  EXPECT_EQ(report.unseen_m2, 0);
}

TEST(UnseenSpace, NothingThatWasSeenIsLost) {
  // A small flat with a hall, a closet and a kitchen front.
  const MultiPolygon2 seen = {Box(0, 0, 3, 3.3),
                              Box(3.7, 0, 7, 3.3),
                              Box(0, 3.4, 7, 4.5),
                              {ParseRing("0,4.6 4,4.6 4,6 2.5,6 2.5,8 0,8"), {}},
                              Box(4.8, 4.6, 7, 8)};
  FloorplanOptions options;
  options.unseen_gap_m = 0;
  const MultiPolygon2 before = Region(Solve(seen, options));
  const FloorplanReport report = Solve(seen);
  const MultiPolygon2 after = Region(report);
  EXPECT_LT(Area(Difference(before, after)), 0.02);
  EXPECT_NEAR(Area(after) - Area(before), report.unseen_m2, 0.02);
  EXPECT_GT(report.unseen_m2, 2);
  for (size_t i = 0; i < after.size(); ++i) {
    for (size_t j = 0; j < i; ++j) EXPECT_LT(Area(Intersection({after[i]}, {after[j]})), 1e-9);
  }
}

}  // namespace
}  // namespace enfilade
