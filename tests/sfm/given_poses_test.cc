// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/given_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "enfilade/base/hash.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/write_home.h"
#include "tests/sfm/pose_errors.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

TEST(IsWorkOnGivenPoses, OnlyWhereAskedAndNeeded) {
  Scene scene;
  scene.pose_source = PoseSource::kColmap;
  EXPECT_FALSE(IsWorkOnGivenPoses({}, scene));
  EXPECT_TRUE(IsWorkOnGivenPoses({.triangulate = true}, scene));
  EXPECT_TRUE(IsWorkOnGivenPoses({.refine = true}, scene));
  scene.points.emplace_back();
  EXPECT_FALSE(IsWorkOnGivenPoses({.triangulate = true}, scene));
  EXPECT_TRUE(IsWorkOnGivenPoses({.refine = true}, scene));
  scene.pose_source = PoseSource::kEstimated;
  EXPECT_FALSE(IsWorkOnGivenPoses({.refine = true}, scene));
}

// A made flat with its panoramas on disk and its true poses.
class GivenPosesTest : public testing::Test {
 protected:
  void SetUp() override {
    const Home home = MakeHome({.seed = 5, .preset = HomePreset::kFlat, .furniture = 0.5});
    WriteHomeOptions writing;
    writing.width = 1024;
    writing.render.samples_per_pixel = 2;
    writing.render.gather_rays = 32;
    writing.render.bounces = 1;
    WriteHome(temp.path(), home, writing, context);
    scene.pose_source = PoseSource::kTransforms;
    for (size_t i = 0; i < home.cameras.size(); ++i) {
      View view;
      view.picture = home.cameras[i].picture;
      view.path = temp.path() / "panos" / view.picture;
      view.sha256 = Sha256OfFile(view.path);
      const ImageSize size = ReadImageSize(view.path);
      view.camera = EquirectangularCamera(size.width, size.height);
      view.world_from_cam = home.WorldFromCamera(static_cast<int>(i));
      truth.push_back(view.world_from_cam);
      scene.views.push_back(view);
    }
    ASSERT_GE(scene.views.size(), 3U);
  }

  GivenPoseReport Find(const GivenPoseOptions& given) {
    PlaceOptions options;
    options.features.source = FeatureSource::kOpenCv;
    options.given = given;
    return FindPointsOfPoses(options, temp.path() / "sfm", "test", context, scene);
  }

  // Root mean square distance from the true positions, in the file's frame.
  double PositionError_m() const {
    double sum = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
      sum += (scene.views[i].world_from_cam.translation - truth[i].translation).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(truth.size()));
  }

  // Root mean square angle to the true rotations.
  double RotationError_rad() const {
    double sum = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
      const double turn = TurnBetween(scene.views[i].world_from_cam.rotation, truth[i].rotation);
      sum += turn * turn;
    }
    return std::sqrt(sum / static_cast<double>(truth.size()));
  }

  void ExpectPointsOnTheirRays(double max_error_rad) const {
    ASSERT_GE(scene.points.size(), 50U);
    for (const ScenePoint& point : scene.points) {
      ASSERT_GE(point.view_idx.size(), 2U);
      ASSERT_EQ(point.pixels.size(), point.view_idx.size());
      for (size_t k = 0; k < point.pixels.size(); ++k) {
        const View& view = scene.views[static_cast<size_t>(point.view_idx[k])];
        const Vector3d to_point = view.world_from_cam.Inverse() * point.position;
        const Vector3d ray = view.camera.RayFromPixel(point.pixels[k].cast<double>());
        EXPECT_LT(AngleBetween(ray, to_point), max_error_rad);
      }
    }
  }

  TempFolder temp;
  Scene scene;
  std::vector<Rigid3> truth;
  RunContext context{2};
};

TEST_F(GivenPosesTest, PointsLieOnTheirRaysAndPosesStay) {
  const GivenPoseReport report = Find({.triangulate = true});
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(report.num_features.size(), truth.size());
  EXPECT_EQ(PositionError_m(), 0);
  ExpectPointsOnTheirRays(DegToRad(1.001));
}

TEST_F(GivenPosesTest, MatchesOnlyWhatIsNearOnOneStorey) {
  EXPECT_TRUE(Find({.triangulate = true, .max_distance_m = 0.5}).pairs.empty());
  EXPECT_TRUE(scene.points.empty());
  for (size_t i = 0; i < scene.views.size(); ++i) scene.views[i].storey_idx = static_cast<int>(i);
  EXPECT_TRUE(Find({.triangulate = true}).pairs.empty());
}

TEST_F(GivenPosesTest, RefinesDisturbedPosesInTheirFrame) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto any = [&]() { return Vector3d(normal(random), normal(random), normal(random)); };
  for (View& view : scene.views) {
    view.world_from_cam.translation += 0.03 * any();
    const Vector3d turn = DegToRad(0.5) * any();
    view.world_from_cam.rotation =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()) * view.world_from_cam.rotation;
  }
  const double before_rad = RotationError_rad(), before_m = PositionError_m();
  const GivenPoseReport report = Find({.refine = true});
  EXPECT_LT(RotationError_rad(), 0.7 * before_rad);
  // Rooms hang together by doors: how they lie to each other is still what the given poses say.
  // How well features agree about it differs a little between kinds of processors.
  EXPECT_LT(PositionError_m(), 1.5 * before_m);
  EXPECT_GT(report.median_shift_m, 0.01);
  ExpectPointsOnTheirRays(DegToRad(0.6));
}

TEST_F(GivenPosesTest, SaysThatPosesAreThoseOfOtherPictures) {
  for (size_t i = 0; i < truth.size(); ++i) {
    scene.views[i].world_from_cam = truth[(i + 1) % truth.size()];
  }
  EXPECT_EQ(Find({.triangulate = true}).warnings.size(), 1U);
}

}  // namespace
}  // namespace enfilade
