// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/sound_polygon.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

Polygon2 RoomWithHoles(std::vector<Ring2> holes) {
  return {ParseRing("0,0 4,0 4,3 0,3"), std::move(holes)};
}

TEST(WithRingsApart, KeepsWhatIsSound) {
  const Polygon2 room = RoomWithHoles({ParseRing("1,1 1,2 2,2 2,1")});
  const Polygon2 kept = WithRingsApart(room, 1e-9);
  EXPECT_EQ(kept.outer, room.outer);
  EXPECT_EQ(kept.holes, room.holes);
}

TEST(WithRingsApart, APillarThatTouchesAWallIsPartOfIt) {
  const Polygon2 room = WithRingsApart(RoomWithHoles({ParseRing("0,1 1,2 2,1")}), 1e-9);
  EXPECT_TRUE(IsSimple(room.outer));
  EXPECT_TRUE(room.holes.empty());
  EXPECT_NEAR(Area(room), 12 - 1, 1e-3);
}

TEST(WithRingsApart, PillarsThatTouchAreOne) {
  const Polygon2 room = WithRingsApart(
      RoomWithHoles({ParseRing("1,1 1,2 2,2 2,1"), ParseRing("2,2 2,2.5 3,2.5 3,2")}), 1e-9);
  ASSERT_EQ(room.holes.size(), 1u);
  EXPECT_TRUE(IsSimple(room.holes[0]));
  EXPECT_NEAR(Area(room), 12 - 1.5, 1e-3);
}

TEST(WithRingsApart, AHoleAcrossTheOuterRingIsCutOut) {
  const Polygon2 room = WithRingsApart(RoomWithHoles({ParseRing("3,1 3,2 5,2 5,1")}), 1e-9);
  EXPECT_TRUE(room.holes.empty());
  EXPECT_NEAR(Area(room), 12 - 1, 1e-3);
}

TEST(LargestRoom, OfNothingIsEmpty) { EXPECT_TRUE(LargestRoom({}, 1e-9).outer.empty()); }

}  // namespace
}  // namespace enfilade
