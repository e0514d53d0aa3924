// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixture_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/text_home.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

PoseNoise Perfect() {
  PoseNoise noise;
  noise.position_sigma_m = noise.yaw_sigma_deg = 0;
  return noise;
}

// Nine cameras in a row, a metre apart.
Home Corridor() {
  std::string text = "room 0,0 10,0 10,2 0,2";
  for (int i = 1; i <= 9; ++i) text += " | camera " + std::to_string(i) + ",1";
  TextHomeOptions options;
  options.heading_rad = 0.4;
  return TextHome(text, options);
}

double YawError(const Home& home, const Scene& scene, int i) {
  const Matrix3d error = scene.views[static_cast<size_t>(i)].world_from_cam.rotation *
                         home.WorldFromCamera(i).rotation.transpose();
  return std::atan2(error(1, 0), error(0, 0));
}

Vector3d PositionError(const Home& home, const Scene& scene, int i) {
  return scene.views[static_cast<size_t>(i)].world_from_cam.translation -
         home.WorldFromCamera(i).translation;
}

// Mean of `value(scene)` over 2000 seeds.
template <typename F>
double MeanOver(const Home& home, PoseNoise noise, const F& value) {
  double sum = 0;
  for (noise.seed = 0; noise.seed < 2000; ++noise.seed) sum += value(FixturePoses(home, noise));
  return sum / 2000;
}

TEST(FixturePoses, WithoutNoiseTheyAreExact) {
  const Home home = Corridor();
  const Scene scene = FixturePoses(home, Perfect(), 512, 256);
  ASSERT_EQ(scene.views.size(), 9u);
  EXPECT_EQ(scene.views[0].camera.width, 512);
  for (int i = 0; i < 9; ++i) {
    EXPECT_LT(PositionError(home, scene, i).norm(), 1e-12);
    EXPECT_TRUE(scene.views[static_cast<size_t>(i)].world_from_cam.rotation.isApprox(
        home.WorldFromCamera(i).rotation, 1e-12));
  }
}

TEST(FixturePoses, IndependentErrorsHaveTheAskedSize) {
  const Home home = Corridor();
  PoseNoise noise;
  noise.tilt_sigma_deg = 0.5;
  const double position = MeanOver(
      home, noise, [&](const Scene& scene) { return PositionError(home, scene, 3).squaredNorm(); });
  EXPECT_NEAR(std::sqrt(position / 3), 0.03, 0.001);
  const double yaw = MeanOver(home, noise, [&](const Scene& scene) {
    return std::pow(RadToDeg(YawError(home, scene, 3)), 2);
  });
  EXPECT_NEAR(std::sqrt(yaw), 0.3, 0.02);
  const double tilt = MeanOver(home, noise, [&](const Scene& scene) {
    const Vector3d down = scene.views[3].world_from_cam.rotation.col(1);
    return std::pow(RadToDeg(std::asin(down.head<2>().norm())), 2);
  });
  EXPECT_NEAR(std::sqrt(tilt / 2), 0.5, 0.02);
  const double shared = MeanOver(home, noise, [&](const Scene& scene) {
    return PositionError(home, scene, 3).dot(PositionError(home, scene, 4));
  });
  EXPECT_NEAR(shared / position, 0, 0.05);
}

TEST(FixturePoses, DriftVarianceGrowsLinearlyWithThePath) {
  const Home home = Corridor();
  PoseNoise drift = Perfect(), turn = Perfect();
  drift.drift_m = 0.05;
  turn.yaw_drift_deg = 0.7;
  for (const int i : {0, 1, 4, 8}) {
    const double position = MeanOver(home, drift, [&](const Scene& scene) {
      return PositionError(home, scene, i).squaredNorm() / 2;
    });
    EXPECT_NEAR(position, 0.05 * 0.05 * i, 0.08 * 0.05 * 0.05 * i) << i;
    const double yaw = MeanOver(home, turn, [&](const Scene& scene) {
      return std::pow(RadToDeg(YawError(home, scene, i)), 2);
    });
    EXPECT_NEAR(yaw, 0.49 * i, 0.1 * 0.49 * i) << i;
  }
}

TEST(FixturePoses, AnErrorOfYawTurnsWhatFollows) {
  const Home home = Corridor();
  PoseNoise noise = Perfect();
  noise.yaw_drift_deg = 3;
  const Scene scene = FixturePoses(home, noise);
  for (int i = 0; i + 1 < 9; ++i) {
    const Vector3d step =
        home.WorldFromCamera(i + 1).translation - home.WorldFromCamera(i).translation;
    const Vector3d walked = scene.views[static_cast<size_t>(i) + 1].world_from_cam.translation -
                            scene.views[static_cast<size_t>(i)].world_from_cam.translation;
    EXPECT_LT((walked - RotationZ(YawError(home, scene, i)) * step).norm(), 1e-9);
  }
}

TEST(FixturePoses, ScaleErrorStretchesAboutTheFirstCamera) {
  const Home home = Corridor();
  PoseNoise noise = Perfect();
  noise.scale_error = -0.02;
  const Scene scene = FixturePoses(home, noise);
  EXPECT_LT(PositionError(home, scene, 0).norm(), 1e-12);
  EXPECT_NEAR(PositionError(home, scene, 5).norm(), 0.1, 1e-9);
}

TEST(FixtureWallSamples, StandAndTurnWhereThePosesSay) {
  const Home home = Corridor();
  PoseNoise noise;
  noise.yaw_sigma_deg = 5;
  const Scene believed = FixturePoses(home, noise);
  const WallSampleSet truth = FixtureWallSamples(home),
                      moved = FixtureWallSamples(home, {}, believed);
  ASSERT_EQ(moved.samples.size(), truth.samples.size());
  for (size_t i = 0; i < truth.samples.size(); i += 97) {
    const WallSample &a = truth.samples[i], &b = moved.samples[i];
    EXPECT_EQ(b.wall_m, a.wall_m);
    const Vector3d origin =
        home.home_from_world *
        believed.views[static_cast<size_t>(a.view_idx)].world_from_cam.translation;
    EXPECT_LT((b.origin - origin.head<2>()).norm(), 1e-12);
    const Matrix3d turn = RotationZ(YawError(home, believed, a.view_idx));
    EXPECT_LT((b.direction - turn.topLeftCorner<2, 2>() * a.direction).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace enfilade
