// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/component_floor.h"

#include <gtest/gtest.h>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/box_outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// One panorama in a room of 4 × 3 m with a corner at the origin.
class ComponentFloorTest : public testing::Test {
 protected:
  RoomOutline outline = BoxOutline({0, 0}, {4, 3}, {1, 1}, 2.5);
  ComponentFloor room{{RoomView{0, Vector3d(1, 1, 1.5), &outline}}};
};

TEST_F(ComponentFloorTest, ContainsWhatLiesBeforeTheWalls) {
  EXPECT_TRUE(room.Contains({3.9, 2.9}, 0));
  EXPECT_FALSE(room.Contains({4.1, 1}, 0));
  EXPECT_TRUE(room.Contains({4.1, 1}, 0.2));
  EXPECT_FALSE(room.Contains({3.9, 1}, -0.2));
}

TEST_F(ComponentFloorTest, SharesAllWithItselfAndNothingWithItsNeighbour) {
  EXPECT_GT(room.OverlapShare(room, Rigid3()), 0.85);  // less the doubtful rim
  EXPECT_NEAR(room.OverlapShare(room, {Eigen::Matrix3d::Identity(), Vector3d(2, 0, 0)}), 0.5, 0.08);
  EXPECT_EQ(room.OverlapShare(room, {Eigen::Matrix3d::Identity(), Vector3d(4, 0, 0)}), 0);
  EXPECT_GT(room.SharedArea_m2(room, {Eigen::Matrix3d::Identity(), Vector3d(4.1, 0, 0)}, 0.4), 0.5);
}

TEST_F(ComponentFloorTest, FollowsATurn) {
  // Turned by 180° about (2, 1.5) the room covers itself.
  const Rigid3 turn{RotationZ(kPi), Vector3d(4, 3, 0)};
  EXPECT_GT(room.OverlapShare(room, turn), 0.85);
  EXPECT_LT(room.OverlapShare(room, {RotationZ(kPi), Vector3d(0, 0, 0)}), 0.02);
}

}  // namespace
}  // namespace enfilade
