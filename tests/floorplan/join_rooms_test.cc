// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/join_rooms.h"

#include <gtest/gtest.h>

#include "tests/floorplan/drawn_evidence.h"

namespace enfilade {
namespace {

// A hall from 0 to 8 m in two pieces with a gap at 4 m, evidence as told.
MultiPolygon2 Gaps(bool has_wall, const std::vector<Polygon2>& rooms, size_t num_entered) {
  EvidenceGrids grids = DrawEvidence({Box(0, 0, 8, 1)});
  if (has_wall) {
    for (const double x : {3.95, 4.05}) AddEvidence(Box(x - 0.025, 0, x + 0.025, 1), -4, 7, grids);
  }
  return FindUnseenWalls(MakeLoopField(grids, {}), 0.15, num_entered, rooms);
}

TEST(JoinRooms, AcrossAWallThatNobodySaw) {
  std::vector<Polygon2> rooms = {Box(0, 0, 3.95, 1), Box(4.05, 0, 8, 1)};
  const MultiPolygon2 gaps = Gaps(false, rooms, 2);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(JoinAcross(gaps, rooms), 1);
  ASSERT_EQ(rooms.size(), 1u);
  EXPECT_NEAR(Area(rooms[0]), 8, 1e-6);
  EXPECT_EQ(rooms[0].outer.size(), 4u);
}

TEST(JoinRooms, NotAcrossAWallThatIsSeen) {
  EXPECT_TRUE(Gaps(true, {Box(0, 0, 3.95, 1), Box(4.05, 0, 8, 1)}, 2).empty());
}

TEST(JoinRooms, NotWithARoomThatNobodyEntered) {
  EXPECT_TRUE(Gaps(false, {Box(0, 0, 3.95, 1), Box(4.05, 0, 8, 1)}, 1).empty());
}

TEST(JoinRooms, NotWhereTheWallGoesOnBesideTheGap) {
  EXPECT_TRUE(Gaps(false, {Box(0, 0, 3.95, 1), Box(4.05, -1, 8, 1)}, 2).empty());
}

TEST(JoinRooms, WhatWasCutAwayIsNotJoined) {
  const MultiPolygon2 gaps = Gaps(false, {Box(0, 0, 3.95, 1), Box(4.05, 0, 8, 1)}, 2);
  std::vector<Polygon2> parts = {Box(0, 0, 2, 1), Box(2.12, 0, 3.95, 1), Box(4.05, 0, 8, 1)};
  EXPECT_EQ(JoinAcross(gaps, parts), 1);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(Area(parts[0]), 2, 1e-9);
  EXPECT_NEAR(Area(parts[1]), 8 - 2.12, 1e-6);
}

}  // namespace
}  // namespace enfilade
