// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/openings.h"

#include <gtest/gtest.h>

#include <string>

#include "enfilade/floorplan/joined_rooms.h"
#include "src/floorplan/facade_store.h"
#include "src/floorplan/split_rooms.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/painted_home.h"
#include "tests/floorplan/storey_of_rooms.h"
#include "tests/support/floorplan_checks.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHead_m = 2.02;

// A wall with what is painted on it: a panel from `from` to `to` along the wall.
PaintedQuad Panel(PaintedQuad wall, double from, double to, double low_z, double high_z,
                  uint8_t gray) {
  wall.from = from;
  wall.to = to;
  wall.low_z = low_z;
  wall.high_z = high_z;
  wall.gray = gray;
  return wall;
}

class OpeningsTest : public testing::Test {
 protected:
  Floorplan Find(const std::vector<Polygon2>& rooms, const std::vector<PaintedQuad>& quads,
                 const std::vector<Vector3d>& cameras) {
    Floorplan plan;
    plan.storeys.push_back(StoreyOf(rooms));
    RunContext context(2);
    report_ = FindOpenings(Shoot(quads, cameras), {}, context, plan);
    ExpectValidFloorplan(plan);
    return plan;
  }

  Scene Shoot(const std::vector<PaintedQuad>& quads, const std::vector<Vector3d>& cameras) {
    Scene scene;
    for (const Vector3d& camera : cameras) {
      const std::string name = std::to_string(scene.views.size()) + ".png";
      scene.views.push_back(PaintView(quads, camera, folder_ / name));
    }
    return scene;
  }

  TempFolder folder_;
  OpeningReport report_;
};

void ExpectSameOpenings(const std::vector<Opening>& x, const std::vector<Opening>& y) {
  ASSERT_EQ(x.size(), y.size());
  for (size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(x[i].a, y[i].a);
    EXPECT_EQ(x[i].b, y[i].b);
    EXPECT_EQ(x[i].head_z, y[i].head_z);
  }
}

void ExpectDoor(const Opening& door, const Vector2d& a, const Vector2d& b, double head_m) {
  EXPECT_EQ(door.kind, OpeningKind::kDoor);
  EXPECT_LT((door.a - a).norm(), 0.04) << door.a.transpose();
  EXPECT_LT((door.b - b).norm(), 0.04) << door.b.transpose();
  EXPECT_NEAR(door.head_z, head_m, 0.04);
  EXPECT_EQ(door.sill_z, 0);
}

TEST_F(OpeningsTest, FindsAShutDoor) {
  std::vector<PaintedQuad> quads = PaintBox(0, 0, 4, 3);
  quads.push_back({1, 3, 1.2, 2.1, 0, kHead_m, 90});
  const Floorplan plan = Find({Box(0, 0, 4, 3)}, quads, {{1.5, 1, 1.5}, {2.5, 1.4, 1.5}});
  ASSERT_EQ(plan.storeys[0].openings.size(), 1u);
  ExpectDoor(plan.storeys[0].openings[0], {2.1, 3}, {1.2, 3}, kHead_m);
  EXPECT_EQ(plan.storeys[0].openings[0].other_room_id, std::nullopt);
  EXPECT_NEAR(report_.door_head_m, kHead_m, 0.04);
}

TEST_F(OpeningsTest, ABareRoomHasNone) {
  const Floorplan plan =
      Find({Box(0, 0, 4, 3)}, PaintBox(0, 0, 4, 3), {{1.5, 1, 1.5}, {2.5, 1.4, 1.5}});
  EXPECT_TRUE(plan.storeys[0].openings.empty());
}

TEST_F(OpeningsTest, WindowsPicturesAndCupboardsAreNoDoors) {
  std::vector<PaintedQuad> quads = PaintBox(0, 0, 4, 3);
  quads.push_back({1, 3, 1.2, 2.4, 0.9, 2.1, 250});  // a window
  quads.push_back({0, 0, 1, 1.7, 1.2, 1.8, 60});     // a picture
  quads.push_back({0, 4, 1.5, 2.5, 0, 2.4, 120});    // a cupboard up to the ceiling
  const Floorplan plan = Find({Box(0, 0, 4, 3)}, quads, {{1.5, 1, 1.5}, {2.5, 1.4, 1.5}});
  ASSERT_EQ(plan.storeys[0].openings.size(), 1u);
  const Opening& window = plan.storeys[0].openings[0];
  EXPECT_EQ(window.kind, OpeningKind::kWindow);
  EXPECT_LT((window.a - Vector2d(2.4, 3)).norm(), 0.04);
  EXPECT_LT((window.b - Vector2d(1.2, 3)).norm(), 0.04);
  EXPECT_NEAR(window.sill_z, 0.9, 0.04);
  EXPECT_NEAR(window.head_z, 2.1, 0.04);
}

TEST_F(OpeningsTest, AShutDoorInACornerThatItsRoomGoesRoundLeadsIntoACloset) {
  std::vector<PaintedQuad> quads = PaintBox(0, 0, 4, 3);
  quads.push_back({1, 2, 0, 1.5});  // closes the corner
  quads.push_back({0, 1.5, 2, 3});
  quads.push_back({1, 2, 0.3, 1.2, 0, kHead_m, 90});
  const Floorplan plan = Find({{ParseRing("0,0 4,0 4,3 1.5,3 1.5,2 0,2"), {}}}, quads,
                              {{1.5, 1, 1.5}, {2.5, 1.4, 1.5}});
  const Storey& storey = plan.storeys[0];
  ASSERT_EQ(storey.openings.size(), 1u);
  ExpectDoor(storey.openings[0], {1.2, 2}, {0.3, 2}, kHead_m);
  EXPECT_EQ(storey.openings[0].other_room_id, 1);
  EXPECT_EQ(report_.num_closets, 1);
  ASSERT_EQ(storey.rooms.size(), 2u);
  EXPECT_NEAR(Area(storey.rooms[1].polygon), 1.38 * 0.88, 0.01);
}

// Two rooms with a wall of 12 cm and a way through it, its casing dark.
std::vector<PaintedQuad> TwoRooms(double from = 1, double to = 1.9) {
  std::vector<PaintedQuad> quads = PaintBox(0, 0, 8, 3);
  for (const double x : {3.94, 4.06}) {
    const PaintedQuad wall{0, x, 0, 3, 0, 2.4, 200};
    for (const auto& [begin, end] : {std::pair{0.0, from}, {to, 3.0}}) {
      quads.push_back(Panel(wall, begin, end, 0, 2.4, 200));
      quads.push_back(Panel(wall, begin, end, 0, 0.08, 150));
    }
    quads.push_back(Panel(wall, from, to, kHead_m, 2.4, 200));
    quads.push_back(Panel(wall, from - 0.07, from, 0, kHead_m + 0.07, 90));
    quads.push_back(Panel(wall, to, to + 0.07, 0, kHead_m + 0.07, 90));
    quads.push_back(Panel(wall, from - 0.07, to + 0.07, kHead_m, kHead_m + 0.07, 90));
  }
  quads.push_back({1, from, 3.94, 4.06, 0, kHead_m, 70});
  quads.push_back({1, to, 3.94, 4.06, 0, kHead_m, 70});
  return quads;
}

TEST_F(OpeningsTest, AWideOpeningJoinsRooms) {
  const Floorplan plan = Find({Box(0, 0, 3.94, 3), Box(4.06, 0, 8, 3)}, TwoRooms(0.6, 2.4),
                              {{1.5, 1.2, 1.5}, {2.5, 2, 1.5}, {5.5, 1, 1.5}, {6.5, 1.8, 1.5}});
  ASSERT_EQ(plan.storeys[0].openings.size(), 1u);
  const Opening& opening = plan.storeys[0].openings[0];
  EXPECT_EQ(opening.kind, OpeningKind::kOpening);
  EXPECT_NEAR((opening.b - opening.a).norm(), 1.87, 0.1);
  EXPECT_EQ(report_.num_openings, 1);
  EXPECT_EQ(FirstJoinedRooms(plan.storeys[0]), (std::vector<size_t>{0, 0}));
}

TEST_F(OpeningsTest, WhatLooksLikeAWideOpeningFromOneSideAloneIsNone) {
  std::vector<PaintedQuad> quads = PaintBox(0, 0, 8, 3);
  for (const double x : {3.94, 4.06}) quads.push_back({0, x, 0, 3});
  quads.push_back({0, 3.93, 0.6, 2.4, 0, kHead_m, 90});  // a wardrobe
  const std::vector<Polygon2> rooms = {Box(0, 0, 3.94, 3), Box(4.06, 0, 8, 3)};
  const std::vector<Vector3d> here = {{1.5, 1.2, 1.5}, {2.5, 2, 1.5}};
  std::vector<Vector3d> both = here;
  both.insert(both.end(), {{5.5, 1, 1.5}, {6.5, 1.8, 1.5}});
  Find(rooms, quads, both);
  EXPECT_EQ(report_.num_openings, 0);
  // Nobody looked at the other side.
  Find(rooms, quads, here);
  EXPECT_EQ(report_.num_openings, 1);
}

TEST_F(OpeningsTest, AWideWayIntoAClosetIsItsDoor) {
  const Floorplan plan = Find({Box(0, 0, 3.94, 3), Box(4.06, 0, 4.9, 3)}, TwoRooms(0.6, 2.4),
                              {{1.5, 1.2, 1.5}, {2.5, 2, 1.5}});
  for (const Opening& opening : plan.storeys[0].openings)
    EXPECT_EQ(opening.kind, OpeningKind::kDoor);
}

TEST_F(OpeningsTest, ADoorSeenFromBothSidesIsOne) {
  const Floorplan plan = Find({Box(0, 0, 3.94, 3), Box(4.06, 0, 8, 3)}, TwoRooms(),
                              {{1.5, 1.2, 1.5}, {2.5, 2, 1.5}, {5.5, 1, 1.5}, {6.5, 1.8, 1.5}});
  ASSERT_EQ(plan.storeys[0].openings.size(), 1u);
  const Opening& door = plan.storeys[0].openings[0];
  EXPECT_NEAR(door.a.x(), 4, 0.07);
  EXPECT_NEAR(0.5 * (door.a.y() + door.b.y()), 1.45, 0.03);
  EXPECT_NEAR((door.b - door.a).norm(), 0.97, 0.1);  // inner or outer edge of the casing
  ASSERT_TRUE(door.other_room_id.has_value());
  EXPECT_NE(*door.other_room_id, door.room_id);
}

TEST_F(OpeningsTest, ViewsWithoutPicturesSayNothing) {
  Floorplan plan;
  plan.storeys.push_back(StoreyOf({Box(0, 0, 4, 3)}));
  Scene scene;
  scene.views.emplace_back();
  RunContext context(1);
  EXPECT_EQ(FindOpenings(scene, {}, context, plan).num_doors, 0);
}

TEST_F(OpeningsTest, SameForAnyNumberOfThreads) {
  const Scene scene = Shoot(TwoRooms(), {{1.5, 1.2, 1.5}, {2.5, 2, 1.5}, {5.5, 1, 1.5}});
  std::vector<Floorplan> plans;
  for (const int num_threads : {1, 3}) {
    RunContext context(num_threads);
    Floorplan& plan = plans.emplace_back();
    plan.storeys.push_back(StoreyOf({Box(0, 0, 3.94, 3), Box(4.06, 0, 8, 3)}));
    FindOpenings(scene, {}, context, plan);
  }
  ExpectSameOpenings(plans[0].storeys[0].openings, plans[1].storeys[0].openings);
}

class SplitRoomsTest : public OpeningsTest {
 protected:
  // The parts of one room from 0 to 8 m with wall evidence at x = 4 beside the door.
  std::vector<Polygon2> Split(const std::vector<PaintedQuad>& quads, bool has_wall_evidence) {
    EvidenceGrids grids = DrawEvidence({room_});
    if (has_wall_evidence) {
      for (const auto& [from, to] : {std::pair{0.0, 1.0}, {1.9, 3.0}}) {
        AddEvidence(Box(3.925, from, 3.95, to), 0, 6, grids);
        AddEvidence(Box(3.95, from, 4.05, to), -6, 0, grids);
      }
    }
    scene_ = Shoot(quads, {{1.5, 1.2, 1.5}, {2.5, 2, 1.5}, {6, 1.4, 1.5}});
    return SplitRoomsAtDoors(scene_, Rigid3(), MakeLoopField(grids, {}), StoreyOf({room_}), 0, 0.12,
                             {}, facades_, context_);
  }

  Polygon2 room_ = Box(0, 0, 8, 3);
  RunContext context_ = RunContext(2);
  FacadeStore facades_ = FacadeStore(context_);
  Scene scene_;
};

TEST_F(SplitRoomsTest, CutsAtAWallWithADoor) {
  const std::vector<Polygon2> parts = Split(TwoRooms(), true);
  ASSERT_EQ(parts.size(), 2u);
  for (const Polygon2& part : parts) {
    EXPECT_EQ(part.outer.size(), 4u);
    EXPECT_NEAR(Area(part), 3.94 * 3, 0.06);
  }
}

TEST_F(SplitRoomsTest, NeedsADoorInThePictures) {
  EXPECT_EQ(Split(PaintBox(0, 0, 8, 3), true).size(), 1u);
}

TEST_F(SplitRoomsTest, WallsThatWereLookedAtAreNotLookedAtAgain) {
  std::vector<PaintedQuad> quads = PaintBox(0, 0, 8, 3);
  quads.push_back({1, 3, 1.2, 2.1, 0, kHead_m, 90});
  ASSERT_EQ(Split(quads, true).size(), 1u);
  Floorplan anew, kept;
  anew.storeys.push_back(StoreyOf({room_}));
  kept.storeys.push_back(StoreyOf({room_}));
  FindOpenings(scene_, {}, context_, anew);
  for (View& view : scene_.views) view.path = folder_ / "gone.png";
  FindOpenings(scene_, {}, context_, kept, &facades_);
  EXPECT_EQ(kept.storeys[0].openings.size(), 1u);
  ExpectSameOpenings(anew.storeys[0].openings, kept.storeys[0].openings);
}

TEST_F(SplitRoomsTest, NeedsWallEvidence) { EXPECT_EQ(Split(TwoRooms(), false).size(), 1u); }

}  // namespace
}  // namespace enfilade
