// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/model/visibility.h"

#include <gtest/gtest.h>

#include <random>

#include "enfilade/model/extrude.h"
#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr const char* kLShape = "0,0 5,0 5,2 2,2 2,4 0,4";

// Two rooms 10 cm apart with a door from x = 4 to x = 4.1 at y in [1, 1.9].
Floorplan RoomsWithDoor() {
  Floorplan plan = MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3"), MakeRoom(1, "4.1,0 7,0 7,3 4.1,3")});
  Opening door;
  door.wall_id = 1;
  door.a = {4, 1};
  door.b = {4, 1.9};
  door.sill_z = 0;
  door.head_z = 2;
  door.room_id = 0;
  door.other_room_id = 1;
  plan.storeys[0].openings.push_back(door);
  return plan;
}

TEST(Visibility, AgreesWithPlaneGeometryInAnLShape) {
  const Floorplan plan = MakePlan({MakeRoom(0, kLShape)});
  const Ring2& ring = plan.storeys[0].rooms[0].polygon.outer;
  const Visibility visibility(ExtrudeFloorplan(plan), plan);
  const Vector3d camera(4, 1, 1.4);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.02, 0.98);
  int num_hidden = 0;
  for (int i = 0; i < 2000; ++i) {
    const size_t edge = static_cast<size_t>(i) % ring.size();
    const double t = uniform(random);
    const Vector2d p = (1 - t) * ring[edge] + t * ring[(edge + 1) % ring.size()];
    const Vector2d offset = p - camera.head<2>();
    const double first = RayDistance(ring, camera.head<2>(), offset.normalized());
    if (std::abs(first - offset.norm()) > 1e-6 && std::abs(first - offset.norm()) < 0.1) continue;
    const bool is_seen = first > offset.norm() - 0.05;
    num_hidden += is_seen ? 0 : 1;
    EXPECT_EQ(visibility.IsSeen(camera, {p.x(), p.y(), 0.02 + 2.3 * uniform(random)}), is_seen)
        << p.transpose();
  }
  EXPECT_GT(num_hidden, 100);
}

TEST(Visibility, PassesThroughDoorsOnly) {
  const Floorplan plan = RoomsWithDoor();
  const Visibility visibility(ExtrudeFloorplan(plan), plan);
  const Vector3d camera(2, 1.45, 1.4);
  EXPECT_TRUE(visibility.IsSeen(camera, {7, 1.45, 1.2}));
  EXPECT_FALSE(visibility.IsSeen(camera, {7, 2.9, 1.2}));             // beside the door
  EXPECT_FALSE(visibility.IsSeen({3.5, 1.45, 2.3}, {7, 1.45, 2.3}));  // above it
  EXPECT_TRUE(visibility.IsSeen(camera, {4, 0.5, 1.2}));              // the wall itself
}

TEST(Visibility, ClosedWhereThePlanHasNoOpening) {
  Floorplan plan = RoomsWithDoor();
  plan.storeys[0].openings[0].kind = OpeningKind::kWindow;
  const Visibility visibility(ExtrudeFloorplan(plan), plan);
  EXPECT_FALSE(visibility.IsSeen({2, 1.45, 1.4}, {7, 1.45, 1.2}));
}

TEST(Visibility, ACameraInADoorwaySeesBothRooms) {
  Floorplan plan = RoomsWithDoor();
  plan.storeys[0].openings.clear();
  const Visibility visibility(ExtrudeFloorplan(plan), plan);
  const Vector3d camera(4.05, 1.45, 1.4);
  EXPECT_TRUE(visibility.IsSeen(camera, {0, 1, 1}));
  EXPECT_TRUE(visibility.IsSeen(camera, {7, 1, 1}));
  EXPECT_FALSE(visibility.IsSeen({-2, 1, 1}, {4, 1, 1}));  // far outside
}

TEST(Visibility, LooksThroughADoorAtTheRoomBehind) {
  Floorplan plan = RoomsWithDoor();
  const BuildingModel model = ExtrudeFloorplan(plan);
  const Vector3d camera(2, 1.45, 1.4);
  const ModelSight through = Visibility(model, plan).Look(camera, {1, 0, 0});
  ASSERT_TRUE(through.face && through.door);
  EXPECT_NEAR(through.face->distance_m, 5, 1e-5);
  EXPECT_EQ(model.faces[static_cast<size_t>(through.face->face_idx)].room_id, 1);
  EXPECT_NEAR(through.door->distance_m, 2, 1e-5);
  EXPECT_EQ(model.faces[static_cast<size_t>(through.door->face_idx)].room_id, 0);
  plan.storeys[0].openings[0].kind = OpeningKind::kOpening;  // has no leaf that may be closed
  EXPECT_FALSE(Visibility(model, plan).Look(camera, {1, 0, 0}).door);
  plan.storeys[0].openings.clear();
  const ModelSight closed = Visibility(model, plan).Look(camera, {1, 0, 0});
  EXPECT_NEAR(closed.face.value().distance_m, 2, 1e-5);
  EXPECT_FALSE(closed.door);
}

TEST(Visibility, SeesNoFaceOutsideTheModelOrFromBehind) {
  const Floorplan plan = RoomsWithDoor();
  const Visibility visibility(ExtrudeFloorplan(plan), plan);
  EXPECT_FALSE(visibility.Look({-2, 1, 1}, {-1, 0, 0}).face);
  EXPECT_FALSE(visibility.Look({-2, 1, 1}, {1, 0, 0}).face);
  EXPECT_TRUE(visibility.Look({-0.1, 1, 1}, {1, 0, 0}).face);  // inside the wall
}

TEST(Visibility, EmptyModelHidesNothing) {
  const Visibility visibility({}, {});
  EXPECT_TRUE(visibility.IsSeen({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(visibility.Look({0, 0, 0}, {1, 0, 0}).face);
}

}  // namespace
}  // namespace enfilade
