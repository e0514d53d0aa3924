// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {
namespace {

TEST(FixtureStructure, ProfileOfAClosedRoomIsItsOutline) {
  TextHomeOptions options;
  options.heading_rad = -0.4;
  options.floor_z = 0.2;
  const Home home = TextHome("room 0,0 4,0 4,3 0,3 | box 3,1 3.6,2 | camera 1,1.5", options);
  const Structure structure = FixtureStructure(home);
  EXPECT_NEAR(structure.heading_rad, -0.4, 1e-12);
  EXPECT_DOUBLE_EQ(structure.storeys[0].floor_z, 0.2);
  ASSERT_EQ(structure.profiles.size(), 1u);
  const WallProfile& profile = structure.profiles[0];
  const int num_bins = profile.wall_probability.cols();
  for (int c = 0; c < profile.num_columns(); ++c) {
    const double azimuth = AzimuthOfColumn(c, profile.num_columns());
    const Eigen::Vector2d direction(std::cos(azimuth), std::sin(azimuth));
    const double expected_m = RayDistance(home.rooms[0].polygon.outer, {1, 1.5}, direction);
    const auto i = static_cast<size_t>(c);
    EXPECT_NEAR(profile.wall_m[i], expected_m, 1e-5);
    EXPECT_LE(profile.obstacle_m[i], profile.wall_m[i]);
    const float* row = profile.wall_probability.row(c);
    EXPECT_NEAR(std::accumulate(row, row + num_bins, 0.0), 1, 1e-4);
    const auto best = static_cast<size_t>(std::max_element(row, row + num_bins) - row);
    EXPECT_NEAR(structure.bin_m[best], expected_m, 0.01 * expected_m);  // half a bin
  }
  EXPECT_NEAR(profile.obstacle_m[256], 2, 0.01);  // straight into the box
}

TEST(FixtureStructure, CamerasLookAtTheWallsOfTheirStorey) {
  const Home home = MakeHome({.seed = 5, .storeys = 2, .furniture = 0});
  const Structure structure = FixtureStructure(home);
  ASSERT_EQ(structure.storeys.size(), 2u);
  EXPECT_GT(structure.storeys[1].floor_z, structure.storeys[0].ceiling_z);
  size_t num_samples = 0;
  for (int storey_idx : {0, 1}) {
    const PlanSegments segments = MakePlanSegments(home, storey_idx);
    const WallSampleSet samples = FixtureWallSamples(home, {}, storey_idx);
    num_samples += samples.samples.size();
    for (size_t i = 0; i < home.cameras.size(); ++i) {
      if (home.StoreyOfCamera(static_cast<int>(i)) != storey_idx) continue;
      const WallProfile& profile = structure.profiles[i];
      EXPECT_DOUBLE_EQ(profile.floor_z, structure.storeys[static_cast<size_t>(storey_idx)].floor_z);
      const auto hit = CastPlanRay(
          segments.walls, home.cameras[i].home_from_cam.translation.head<2>(),
          Eigen::Rotation2Dd(AzimuthOfColumn(100, profile.num_columns())) * Eigen::Vector2d(1, 0));
      EXPECT_NEAR(profile.wall_m[100], hit.value().distance_m, 1e-5);
    }
  }
  EXPECT_EQ(num_samples, 512 * home.cameras.size());
}

TEST(FixtureWallSamples, NoiseHasTheAskedSize) {
  const Home home = TextHome("room 0,0 5,0 5,4 0,4");
  ProfileNoise noise;
  noise.num_columns = 4096;
  const WallSampleSet perfect = FixtureWallSamples(home, noise);
  ASSERT_EQ(perfect.samples.size(), 4096u);
  const auto n = static_cast<double>(perfect.samples.size());
  ProfileNoise unseen = noise;
  unseen.unseen_share = 0.25;
  const auto num_seen = static_cast<double>(FixtureWallSamples(home, unseen).samples.size());
  EXPECT_NEAR(num_seen / n, 0.75, 0.03);
  ProfileNoise blurred = noise;
  blurred.sigma_relative = 0.02;
  ProfileNoise outliers = noise;
  outliers.outlier_share = 0.1;
  const WallSampleSet noisy = FixtureWallSamples(home, blurred);
  const WallSampleSet wild = FixtureWallSamples(home, outliers);
  double squares = 0, num_outliers = 0;
  for (size_t i = 0; i < perfect.samples.size(); ++i) {
    squares += std::pow(noisy.samples[i].wall_m / perfect.samples[i].wall_m - 1, 2);
    num_outliers += std::abs(wild.samples[i].wall_m - perfect.samples[i].wall_m) > 1e-3 ? 1 : 0;
  }
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 0.001);
  EXPECT_NEAR(num_outliers / n, 0.1, 0.02);
}

TEST(FixtureWallSamples, OpenDoorsCanBeMadeWalls) {
  const Home home =
      TextHome("room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8 | camera 1,1.4");
  ProfileNoise noise;
  noise.num_columns = 512;
  EXPECT_NEAR(FixtureWallSamples(home, noise).samples[256].wall_m, 7, 0.01);
  noise.are_doors_walls = true;
  EXPECT_NEAR(FixtureWallSamples(home, noise).samples[256].wall_m, 3, 0.01);
}

TEST(FixtureScene, PosesAreThoseOfTheHome) {
  TextHomeOptions options;
  options.heading_rad = 0.25;
  const Home home = TextHome("room 0,0 4,0 4,3 0,3 | camera 1,2", options);
  const Scene scene = FixtureScene(home, 512, 256);
  ASSERT_EQ(scene.views.size(), 1u);
  const Rigid3 home_from_cam = home.home_from_world * scene.views[0].world_from_cam;
  EXPECT_NEAR((home_from_cam.translation - Eigen::Vector3d(1, 2, 1.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((home_from_cam.rotation * Eigen::Vector3d(0, 1, 0)).z(), -1, 1e-12);  // y down
  EXPECT_EQ(scene.views[0].camera.width, 512);
}

}  // namespace
}  // namespace enfilade
