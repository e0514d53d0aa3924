// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/room_outline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/box_outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A room of 4 × 3 m, the camera at (1, 1).
RoomOutline Room() { return BoxOutline({0, 0}, {4, 3}, {1, 1}, 2.5); }

TEST(RoomOutline, TellsTheWallInEveryDirection) {
  const RoomOutline room = Room();
  EXPECT_NEAR(room.WallDistance({1, 0}), 3, 1e-3);
  EXPECT_NEAR(room.WallDistance({-7, 0}), 1, 1e-3);
  EXPECT_NEAR(room.WallDistance({0, 2}), 2, 1e-3);
  EXPECT_NEAR(room.WallDistance({0, -1}), 1, 1e-3);
}

TEST(RoomOutline, CountsColumnsFromItsFirstAzimuth) {
  RoomOutline room = Room();
  room.first_azimuth_rad += kPi / 2;
  EXPECT_NEAR(room.WallDistance({0, 1}), 3, 1e-3);
}

TEST(RoomOutline, MeetsWhicheverSurfaceComesFirst) {
  const RoomOutline room = Room();
  EXPECT_NEAR(room.SurfaceDistance(1.5, {1, 0, 0}), 3, 1e-3);
  EXPECT_NEAR(room.SurfaceDistance(1.5, {0, 0, -1}), 1.5, 1e-9);
  EXPECT_NEAR(room.SurfaceDistance(1.5, {0, 0, 1}), 1.0, 1e-9);
  const Vector3d down = Vector3d(1, 0, -1).normalized();  // the floor before the wall
  EXPECT_NEAR(room.SurfaceDistance(1.5, down), 1.5 * std::sqrt(2.0), 1e-9);
  const Vector3d far = Vector3d(3, 0, -1).normalized();  // the wall, half a metre above the floor
  EXPECT_NEAR(room.SurfaceDistance(1.5, far), std::sqrt(10.0), 1e-3);
}

}  // namespace
}  // namespace enfilade
