// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/leaks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "enfilade/geometry/boolean.h"
#include "src/floorplan/necks.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/solve_drawn.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

const Polygon2 kRoom = Box(0, 0, 5, 4);
const Vector2d kCamera(2, 2);

EvidenceGrids Draw(const MultiPolygon2& free, const std::vector<Vector2d>& cameras) {
  EvidenceGrids grids = DrawEvidence(free);
  for (const Vector2d& camera : cameras)
    grids.cameras.push_back({static_cast<int>(grids.cameras.size()), camera});
  return grids;
}

/// Forgets the walls of `space` as far as they lie in `where`, which holds nothing else.
void ForgetWalls(const Polygon2& space, Polygon2 where, EvidenceGrids& grids) {
  for (const Polygon2& inside : Offset({space}, -0.08)) {
    where.holes.push_back(inside.outer);
    std::reverse(where.holes.back().begin(), where.holes.back().end());
  }
  EraseEvidence(where, grids);
}

double Wrong(const MultiPolygon2& a, const MultiPolygon2& b) {
  return Area(Difference(a, b)) + Area(Difference(b, a));
}

/// Expects these rooms with the corners that they truly have.
void ExpectRooms(const FloorplanReport& report, const MultiPolygon2& truth) {
  const MultiPolygon2 rooms = RoomsOf(report.plan);
  ASSERT_EQ(rooms.size(), truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(Wrong({rooms[i]}, {truth[i]}), 0.05) << RingToText(rooms[i].outer);
    EXPECT_EQ(rooms[i].outer.size(), truth[i].outer.size());
  }
}

/// A garden behind a window: a fan of rays up to a fence. Its sides are no walls.
struct Garden {
  Polygon2 window = Box(4.9, 1.2, 5.2, 2.6);
  Polygon2 fan = {ParseRing("5.1,1.2 7.5,0.1 7.5,3.7 5.1,2.6"), {}};
  Polygon2 sides = Box(5.13, -1, 7.4, 5);

  [[nodiscard]] EvidenceGrids Seen(const std::vector<Vector2d>& cameras) const {
    EvidenceGrids grids = Draw(Union({kRoom, window, fan}), cameras);
    ForgetWalls(fan, sides, grids);
    return grids;
  }
};

TEST(Leaks, AFanOfRaysBehindAWindowIsLeftOut) {
  const FloorplanReport report = SolveDrawn(Garden().Seen({kCamera}));
  ExpectRooms(report, {kRoom});
  EXPECT_EQ(report.num_leaks, 1);
  EXPECT_EQ(report.num_mirrors, 0);
  EXPECT_GT(report.leaks_m2, 5);
}

TEST(Leaks, AGardenBehindAGlassDoorIsLeftOut) {
  // Nothing ends the view.
  const Garden garden{
      Box(4.9, 0.8, 5.2, 3.1), {ParseRing("5.1,0.8 9,-1 9,5 5.1,3.1"), {}}, Box(5.13, -2, 10, 6)};
  const FloorplanReport report = SolveDrawn(garden.Seen({kCamera}));
  ExpectRooms(report, {kRoom});
  EXPECT_EQ(report.num_leaks, 1);
}

TEST(Leaks, WhereAPanoramaWasTakenIsNoLeak) {
  const FloorplanReport report = SolveDrawn(Garden().Seen({kCamera, {6.5, 2}}));
  EXPECT_EQ(report.num_leaks, 0);
  EXPECT_GT(Area(RoomsOf(report.plan)), Area(kRoom) + 5);
}

TEST(Leaks, TheyStayIfAsked) {
  FloorplanOptions options;
  options.max_neck_m = 0;
  const FloorplanReport report = SolveDrawn(Garden().Seen({kCamera}), options);
  EXPECT_EQ(report.num_leaks, 0);
  EXPECT_GT(Area(RoomsOf(report.plan)), Area(kRoom) + 5);
}

/// What a mirror of 1.4 m at x = 5 shows of the room, if the room behind it is depth_m deep. The
/// wall round the mirror is not seen from behind.
EvidenceGrids SeenInMirror(double depth_m) {
  EvidenceGrids grids =
      Draw(Union({kRoom, Box(4.9, 1.2, 5.2, 2.6), Box(5.1, 0, 5 + depth_m, 4)}), {kCamera});
  for (const auto& [from, to] : {std::pair(-0.2, 1.15), std::pair(2.65, 4.2)})
    EraseEvidence(Box(5.08, from, 5.3, to), grids);
  return grids;
}

TEST(Leaks, TheRoomReflectedInAMirrorIsLeftOut) {
  const FloorplanReport report = SolveDrawn(SeenInMirror(5));
  ExpectRooms(report, {kRoom});
  EXPECT_EQ(report.num_mirrors, 1);
}

TEST(Leaks, ARoomThatIsNoReflectionStays) {
  const FloorplanReport report = SolveDrawn(SeenInMirror(4.5));
  EXPECT_EQ(report.num_leaks, 0);
  EXPECT_GT(Area(RoomsOf(report.plan)), Area(kRoom) + 12);
}

TEST(Leaks, AClosetSeenThroughItsDoorIsARoomOfItsOwn) {
  const Polygon2 closet = Box(5.1, 1, 6.4, 3);
  EvidenceGrids grids = Draw(Union({kRoom, closet, Box(4.9, 1.6, 5.2, 2.4)}), {kCamera});
  // Nobody sees the wall that the door is in from behind, nor the corners beside it.
  for (const auto& [from, to] : {std::pair(0.9, 1.55), std::pair(2.45, 3.1)})
    EraseEvidence(Box(5.08, from, 5.6, to), grids);
  const FloorplanReport report = SolveDrawn(grids);
  ExpectRooms(report, {kRoom, closet});
  EXPECT_EQ(report.num_leaks, 0);
  EXPECT_EQ(report.num_set_apart, 1);
  const Storey& storey = report.plan.storeys[0];
  for (const Wall& wall : storey.walls) {
    if (wall.room_id != storey.rooms[1].id) continue;
    const double x = 0.5 * (wall.a.x() + wall.b.x());
    EXPECT_EQ(wall.seen, x < 5.3   ? WallSeen::kInferred
                         : x > 6.3 ? WallSeen::kSeen
                                   : WallSeen::kPartly)
        << x;
  }
}

TEST(Leaks, ACupboardIsNoRoom) {
  const MultiPolygon2 truth = Union({kRoom, Box(5.1, 1, 5.6, 3), Box(4.9, 1.6, 5.2, 2.4)});
  const FloorplanReport report = SolveDrawn(Draw(truth, {kCamera}));
  ExpectRooms(report, truth);
  EXPECT_EQ(report.num_set_apart, 0);
}

TEST(Leaks, ABayStays) {
  for (const double depth_m : {0.4, 0.8}) {
    SCOPED_TRACE(depth_m);
    const MultiPolygon2 truth = Union({kRoom, Box(4.9, 1, 5 + depth_m, 2.8)});
    const FloorplanReport report = SolveDrawn(Draw(truth, {kCamera}));
    ExpectRooms(report, truth);
    EXPECT_EQ(report.num_leaks, 0);
  }
}

TEST(Leaks, TheNumberOfThreadsChangesNothing) {
  EvidenceGrids grids = Garden().Seen({kCamera});
  const MultiPolygon2 one = RoomsOf(SolveDrawn(grids, {}, 1).plan),
                      four = RoomsOf(SolveDrawn(grids, {}, 4).plan);
  ASSERT_EQ(one.size(), four.size());
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].outer, four[i].outer);
}

std::vector<Neck> NecksOf(const Polygon2& room, const std::vector<Vector2d>& cameras) {
  return FindNecks(room, cameras, 2.5, 0.25);
}

TEST(FindNecks, ADoorHasTwo) {
  const Polygon2 room = Union({kRoom, Box(5.1, 0, 8, 4), Box(4.9, 1.6, 5.2, 2.4)})[0];
  const std::vector<Neck> necks = NecksOf(room, {kCamera});
  for (const double x : {5.0, 5.1}) {
    const auto found = std::find_if(necks.begin(), necks.end(), [&](const Neck& neck) {
      return neck.a.isApprox(Vector2d(x, 2.4)) && neck.b.isApprox(Vector2d(x, 1.6));
    });
    ASSERT_NE(found, necks.end()) << x;
    EXPECT_EQ(found->is_near_straight, x == 5.0);
    EXPECT_EQ(found->is_beyond_straight, x == 5.1);
    EXPECT_NEAR(Area(found->near) + Area(found->beyond), Area(room), 1e-9);
    EXPECT_EQ(found->beyond.outer[0], found->a);
    EXPECT_EQ(found->beyond.outer[1], found->b);
  }
}

TEST(FindNecks, ADoorInACornerIsANeck) {
  const Polygon2 room = {ParseRing("0,0 7,0 7,4 5.1,4 5.1,0.8 5,0.8 5,4 0,4"), {}};
  const std::vector<Neck> necks = NecksOf(room, {kCamera});
  EXPECT_TRUE(std::any_of(necks.begin(), necks.end(), [](const Neck& neck) {
    return neck.is_near_straight && neck.a.isApprox(Vector2d(5, 0.8)) &&
           neck.b.isApprox(Vector2d(5, 0), 1e-9);
  }));
}

TEST(FindNecks, AnArmOrALineAcrossARoomIsNone) {
  EXPECT_TRUE(NecksOf({ParseRing("0,0 5,0 5,2 2,2 2,4 0,4"), {}}, {{4, 1}}).empty());
  // Chimney breasts across from each other, not in line.
  EXPECT_TRUE(NecksOf({ParseRing("0,0 2,0 2,1 3,1 3,0 8,0 8,4 6,4 6,3 5,3 5,4 0,4"), {}}, {{1, 2}})
                  .empty());
}

TEST(FindNecks, AJogBesideTheCornerOfAnArmIsNoWallThatEndsThere) {
  const Vector2d camera(1, 1);
  const auto room_with_wall_end = [](double face_m) {
    return Polygon2{
        {{0, 0}, {5, 0}, {5, 5}, {3 - face_m, 5}, {3 - face_m, 2.2}, {3, 2.2}, {3, 2}, {0, 2}}, {}};
  };
  EXPECT_TRUE(NecksOf(room_with_wall_end(0.2), {camera}).empty());
  EXPECT_FALSE(NecksOf(room_with_wall_end(0.4), {camera}).empty());
}

TEST(FindNecks, CamerasOnBothSidesOrNoneMeanThatItWasPassed) {
  const Polygon2 room = Union({kRoom, Box(5.1, 0, 8, 4), Box(4.9, 1.6, 5.2, 2.4)})[0];
  EXPECT_TRUE(NecksOf(room, {kCamera, {7, 2}}).empty());
  EXPECT_TRUE(NecksOf(room, {}).empty());
}

}  // namespace
}  // namespace enfilade
