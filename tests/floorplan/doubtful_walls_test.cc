// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/doubtful_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "enfilade/geometry/boolean.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/storey_of_rooms.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// Rooms as they were drawn, and what is free in truth, as far as the evidence knows.
class DoubtfulWallsTest : public testing::Test {
 protected:
  void Draw(const std::vector<Polygon2>& rooms) {
    storey_ = StoreyOf(rooms);
    WallSigma sure;
    sure.wrong_probability = 0.05;
    sigmas_.assign(storey_.walls.size(), sure);
  }

  // The wall through a point is another surface's with this probability.
  Wall& Doubt(const Vector2d& point, double wrong_probability) {
    const auto wall =
        std::find_if(storey_.walls.begin(), storey_.walls.end(), [&](const Wall& candidate) {
          return DistanceToSegment(point, candidate.a, candidate.b) < 1e-6;
        });
    EXPECT_NE(wall, storey_.walls.end());
    sigmas_[static_cast<size_t>(wall - storey_.walls.begin())].wrong_probability =
        wrong_probability;
    return *wall;
  }

  std::vector<Polygon2> Moved(const MultiPolygon2& free) {
    std::vector<Polygon2> polygons;
    for (const Room& room : storey_.rooms) polygons.push_back(room.polygon);
    const LoopField field = NormaliseEvidence(DrawEvidence(free), {});
    num_moved_ = MoveDoubtfulWalls(field, {}, storey_, sigmas_, polygons);
    return polygons;
  }

  Storey storey_;
  std::vector<WallSigma> sigmas_;
  int num_moved_ = 0;
};

void ExpectRegion(const Polygon2& found, const Polygon2& expected) {
  EXPECT_GT(AreaIou({found}, {expected}), 0.9999);
  EXPECT_EQ(found.outer.size(), expected.outer.size());
}

const Polygon2 kLeft = Box(0, 0, 4, 3), kRight = Box(4.12, 0, 8, 3);
const Polygon2 kRightBeforeWardrobe = Box(4.12, 0, 8, 2.4);
const Vector2d kFront(6, 2.4);

TEST_F(DoubtfulWallsTest, AFrontGoesOntoTheLineOfTheWallInTheNextRoom) {
  Draw({kLeft, kRightBeforeWardrobe});
  Doubt(kFront, 0.5);
  const std::vector<Polygon2> rooms = Moved({kLeft, kRight});
  EXPECT_EQ(num_moved_, 1);
  ExpectRegion(rooms[0], kLeft);
  ExpectRegion(rooms[1], kRight);
}

TEST_F(DoubtfulWallsTest, NotIfItIsSureOrThatWallIsNot) {
  Draw({kLeft, kRightBeforeWardrobe});
  Doubt(kFront, 0.15);
  EXPECT_EQ(Moved({kLeft, kRight})[1].outer, kRightBeforeWardrobe.outer);
  Doubt(kFront, 0.5);
  Doubt({2, 3}, 0.3);
  EXPECT_EQ(Moved({kLeft, kRight})[1].outer, kRightBeforeWardrobe.outer);
  EXPECT_EQ(num_moved_, 0);
}

TEST_F(DoubtfulWallsTest, NotWhereNobodySawFreeSpaceBehindItUnlessItsLineMayBeOffSoFar) {
  Draw({kLeft, kRightBeforeWardrobe});
  Doubt(kFront, 0.5);
  EXPECT_EQ(Moved({kLeft, kRightBeforeWardrobe})[1].outer, kRightBeforeWardrobe.outer);
  const Polygon2 near = Box(4.12, 0, 8, 2.85);
  Draw({kLeft, near});
  Doubt({6, 2.85}, 0.5);
  ExpectRegion(Moved({kLeft, near})[1], kRight);
}

TEST_F(DoubtfulWallsTest, NotFartherThanFurnitureIsDeep) {
  const Polygon2 shallow = Box(4.12, 0, 8, 2.2);
  Draw({kLeft, shallow});
  Doubt({6, 2.2}, 0.5);
  EXPECT_EQ(Moved({kLeft, kRight})[1].outer, shallow.outer);
}

TEST_F(DoubtfulWallsTest, NotIntoAnotherRoom) {
  Draw({kLeft, kRightBeforeWardrobe, Box(4.12, 2.52, 8, 6)});
  Doubt(kFront, 0.5);
  EXPECT_EQ(Moved({kLeft, kRight})[1].outer, kRightBeforeWardrobe.outer);
}

TEST_F(DoubtfulWallsTest, NotOntoAWallOfARoomFarAside) {
  const Polygon2 far = Box(4.7, 0, 8, 2.4);
  Draw({kLeft, far});
  Doubt(kFront, 0.5);
  EXPECT_EQ(Moved({kLeft, Box(4.7, 0, 8, 3)})[1].outer, far.outer);
}

TEST_F(DoubtfulWallsTest, AWardrobeInARoomIsPassedButNoShortWallBesideABay) {
  const auto room_with = [](double width_m) {
    return Polygon2{{{0, 0}, {4, 0}, {4, 3}, {width_m, 3}, {width_m, 2.4}, {0, 2.4}}, {}};
  };
  Draw({room_with(1.8)});
  Doubt({0.9, 2.4}, 0.5);
  ExpectRegion(Moved({kLeft})[0], kLeft);
  Doubt({0.9, 2.4}, 0.5).seen = WallSeen::kInferred;
  EXPECT_EQ(Moved({kLeft})[0].outer, room_with(1.8).outer);
  Draw({room_with(0.5)});
  Doubt({0.25, 2.4}, 0.5);
  EXPECT_EQ(Moved({kLeft})[0].outer, room_with(0.5).outer);
}

TEST_F(DoubtfulWallsTest, AWallThatPartsItsRoomStays) {
  const Polygon2 room{ParseRing("0,0 6,0 6,2 0,2 0,1.5 3,1.5 3,1.4 0,1.4"), {}};
  Draw({room});
  Doubt({1.5, 1.4}, 0.5);
  EXPECT_EQ(Moved({room})[0].outer, room.outer);
}

}  // namespace
}  // namespace enfilade
