// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Home Make(int seed, HomePreset preset, double tilt_deg, int storeys = 1) {
  HomeOptions options;
  options.seed = seed;
  options.preset = preset;
  options.tilt_deg = tilt_deg;
  options.storeys = storeys;
  return MakeHome(options);
}

void ExpectSameRoomsAndFurniture(const Home& a, const Home& b) {
  EXPECT_EQ(a.home_from_world.rotation, b.home_from_world.rotation);
  EXPECT_EQ(a.baseboard_m, b.baseboard_m);
  ASSERT_EQ(a.rooms.size(), b.rooms.size());
  for (size_t i = 0; i < a.rooms.size(); ++i) {
    EXPECT_EQ(a.rooms[i].polygon.outer, b.rooms[i].polygon.outer);
    EXPECT_EQ(a.rooms[i].ceiling_z, b.rooms[i].ceiling_z);
    EXPECT_EQ(a.rooms[i].wall_rgb, b.rooms[i].wall_rgb);
  }
  ASSERT_EQ(a.openings.size(), b.openings.size());
  for (size_t i = 0; i < a.openings.size(); ++i) {
    EXPECT_EQ(a.openings[i].a, b.openings[i].a);
    EXPECT_EQ(a.openings[i].leaf_angle_rad, b.openings[i].leaf_angle_rad);
  }
  ASSERT_EQ(a.boxes.size(), b.boxes.size());
  for (size_t i = 0; i < a.boxes.size(); ++i) {
    EXPECT_EQ(a.boxes[i].center, b.boxes[i].center);
    EXPECT_EQ(a.boxes[i].size, b.boxes[i].size);
  }
  ASSERT_EQ(a.lamps.size(), b.lamps.size());
  for (size_t i = 0; i < a.lamps.size(); ++i) {
    EXPECT_EQ(a.lamps[i].center, b.lamps[i].center);
    EXPECT_EQ(a.lamps[i].radiance, b.lamps[i].radiance);
  }
  ASSERT_EQ(a.sun.has_value(), b.sun.has_value());
  if (a.sun) {
    EXPECT_EQ(a.sun->direction, b.sun->direction);
  }
}

// How each camera of `tilted` is turned from where it is in `plain`: angle times axis, home frame.
// Checks that nothing but the rotation differs, and that what is claimed turns likewise.
std::vector<Vector3d> TurnsBetween(const Home& plain, const Home& tilted) {
  std::vector<Vector3d> turns;
  EXPECT_EQ(plain.cameras.size(), tilted.cameras.size());
  for (size_t i = 0; i < plain.cameras.size(); ++i) {
    const HomeCamera &a = plain.cameras[i], &b = tilted.cameras[i];
    EXPECT_EQ(a.picture, b.picture);
    EXPECT_EQ(a.room_id, b.room_id);
    EXPECT_EQ(a.exposure, b.exposure);
    EXPECT_EQ(a.home_from_cam.translation, b.home_from_cam.translation);
    const Matrix3d turn = b.home_from_cam.rotation * a.home_from_cam.rotation.transpose();
    EXPECT_TRUE((turn.transpose() * turn).isIdentity(1e-12));
    EXPECT_EQ(a.claimed_home_from_cam.has_value(), b.claimed_home_from_cam.has_value());
    if (a.claimed_home_from_cam) {
      EXPECT_EQ(a.claimed_home_from_cam->translation, b.claimed_home_from_cam->translation);
      const Matrix3d claimed =
          b.claimed_home_from_cam->rotation * a.claimed_home_from_cam->rotation.transpose();
      EXPECT_TRUE(claimed.isApprox(turn, 1e-12));
    }
    const Eigen::AngleAxisd angle_axis(turn);
    turns.emplace_back(angle_axis.angle() * angle_axis.axis());
  }
  return turns;
}

TEST(MakeHome, TiltTurnsTheCamerasAndNothingElse) {
  for (const HomePreset preset : {HomePreset::kRoom, HomePreset::kFlat, HomePreset::kTour,
                                  HomePreset::kHard, HomePreset::kWalk, HomePreset::kBuilding}) {
    const Home plain = Make(7, preset, 0), tilted = Make(7, preset, 20);
    ExpectSameRoomsAndFurniture(plain, tilted);
    EXPECT_THAT(HomeProblems(tilted), testing::IsEmpty());
    for (const Vector3d& turn : TurnsBetween(plain, tilted)) {
      EXPECT_GT(turn.norm(), 0);
      EXPECT_LE(turn.norm(), DegToRad(20) + 1e-9);
      EXPECT_NEAR(turn.z(), 0, 1e-9);
    }
  }
}

TEST(MakeHome, TiltReachesEveryStorey) {
  const Home plain = Make(3, HomePreset::kFlat, 0, 2), tilted = Make(3, HomePreset::kFlat, 5, 2);
  ExpectSameRoomsAndFurniture(plain, tilted);
  for (const Vector3d& turn : TurnsBetween(plain, tilted)) EXPECT_GT(turn.norm(), 0);
}

// Means of n = 1000 or more: the angle's error is tilt/√12/√n, that of a unit axis' coordinate
// 1/√(2n); the bounds are four of them.
TEST(MakeHome, TiltIsUniformInAngleAndAzimuth) {
  constexpr double kTilt_deg = 12;
  double sum_deg = 0, most_deg = 0;
  Eigen::Vector2d sum_axis(0, 0);
  int n = 0;
  for (int seed = 0; n < 1000; ++seed) {
    const Home plain = Make(seed, HomePreset::kTour, 0);
    for (const Vector3d& turn : TurnsBetween(plain, Make(seed, HomePreset::kTour, kTilt_deg))) {
      const double angle_deg = RadToDeg(turn.norm());
      sum_deg += angle_deg;
      most_deg = std::max(most_deg, angle_deg);
      sum_axis += turn.head<2>().normalized();
      ++n;
    }
  }
  EXPECT_NEAR(sum_deg / n, kTilt_deg / 2, 4 * kTilt_deg / std::sqrt(12.0 * n));
  EXPECT_GT(most_deg, 0.98 * kTilt_deg);
  EXPECT_LT(sum_axis.lpNorm<Eigen::Infinity>() / n, 4 / std::sqrt(2.0 * n));
}

TEST(MakeHome, RefusesTiltOutOfRange) {
  EXPECT_THROW((void)Make(1, HomePreset::kFlat, -1), InvalidInputError);
  EXPECT_THROW((void)Make(1, HomePreset::kFlat, 30.5), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
