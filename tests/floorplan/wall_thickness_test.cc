// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/wall_thickness.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/storey_of_rooms.h"

namespace enfilade {
namespace {

// Walls of boxes: 0 below, 1 right, 2 above, 3 left of the first box, and so on.

TEST(WallThickness, IsTheGapBetweenTwoSeenFaces) {
  Storey storey = StoreyOf({Box(0, 0, 4, 3), Box(4.2, 0, 8, 3)});
  MeasureThickness(0.45, storey);
  for (const auto& [wall, behind] : {std::pair{1, 1}, {7, 0}}) {
    const Wall& inner = storey.walls[static_cast<size_t>(wall)];
    EXPECT_EQ(inner.other_room_id, behind);
    EXPECT_NEAR(inner.thickness_m, 0.2, 1e-9);
    EXPECT_TRUE(inner.is_thickness_measured);
  }
  EXPECT_EQ(storey.walls[0].other_room_id, std::nullopt);
  EXPECT_EQ(storey.walls[0].thickness_m, 0.12);
  EXPECT_FALSE(storey.walls[0].is_thickness_measured);
}

TEST(WallThickness, IsAssumedWhereAFaceIsInferred) {
  Storey storey = StoreyOf({Box(0, 0, 4, 3), Box(4.2, 0, 8, 3)});
  storey.walls[7].seen = WallSeen::kInferred;
  MeasureThickness(0.45, storey);
  EXPECT_NEAR(storey.walls[1].thickness_m, 0.2, 1e-9);
  EXPECT_FALSE(storey.walls[1].is_thickness_measured);
}

TEST(WallThickness, FacesFarApartOrBesideEachOtherAreNoWall) {
  Storey storey = StoreyOf({Box(0, 0, 4, 3), Box(4.6, 0, 8, 3), Box(4.2, 2.5, 4.5, 8)});
  MeasureThickness(0.45, storey);
  EXPECT_EQ(storey.walls[1].other_room_id, std::nullopt);
}

TEST(WallThickness, OfSeveralRoomsTheOneAlongMostOfItCounts) {
  Storey storey = StoreyOf({Box(0, 0, 4, 3), Box(4.1, 0, 8, 1), Box(4.15, 1.1, 8, 3)});
  MeasureThickness(0.45, storey);
  EXPECT_EQ(storey.walls[1].other_room_id, 2);
  EXPECT_NEAR(storey.walls[1].thickness_m, 0.15, 1e-9);
}

}  // namespace
}  // namespace enfilade
