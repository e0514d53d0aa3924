// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/wall_matches.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/features.h"
#include "enfilade/sfm/gravity.h"
#include "src/sfm/match_pairs.h"
#include "src/sfm/view_ring.h"
#include "tests/sfm/blob_panorama.h"
#include "tests/sfm/pose_errors.h"
#include "tests/sfm/random_descriptors.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(WallViewFrame, AreSixRightHandedViewsInAllDirections) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < kNumWallViews; ++k) {
    const Matrix3d frame = WallViewFrame(k);
    EXPECT_NEAR(frame.determinant(), 1, 1e-12);
    EXPECT_TRUE((frame.transpose() * frame).isIdentity(1e-12));
    sum += frame.col(2);
    EXPECT_EQ(frame.col(1).isApprox(-Vector3d::UnitZ()), k < kNumLevelWallViews);
  }
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST(MoveView, FollowsTurnsAndMirrors) {
  for (int k = 0; k < kNumWallViews; ++k) {
    EXPECT_EQ(MoveView(k, Matrix3d::Identity()).view, k);
    const MovedView quarter = MoveView(k, RotationZ(kPi / 2));
    EXPECT_EQ(quarter.view, k < kNumLevelWallViews ? (k + 1) % kNumLevelWallViews : k);
    // An order of 128 values, and four quarters are none.
    EXPECT_EQ(std::set<uint8_t>(quarter.order.begin(), quarter.order.end()).size(), 128U);
    const MovedView back = MoveView(quarter.view, RotationZ(-kPi / 2));
    for (size_t i = 0; i < quarter.order.size(); ++i) {
      EXPECT_EQ(quarter.order[back.order[i]], i);
    }
  }
}

// The order of SIFT's values against what is found when the heading is told a quarter turn off.
TEST(MatchWalls, TurnsFloorsAndCeilingsByQuarters) {
  constexpr int kRows = 512;
  const ImageU8 panorama = BlobPanorama(kRows, 9);
  const ImageU8 trusted(kRows, 2 * kRows, 1, 255);
  const Camera camera = EquirectangularCamera(2 * kRows, kRows);
  const auto look = [&](double heading_rad) {
    Gravity gravity;
    gravity.heading_rad = heading_rad;
    return ExtractFeatures(panorama, trusted, camera, CamFromWalls(gravity), {});
  };
  const PanoFeatures features = look(0.2);
  for (int quarters = 0; quarters < kNumTurns; ++quarters) {
    const PanoFeatures turned = look(0.2 - quarters * kPi / 2);
    std::array<int, kNumWallViews> num_features{}, num_right{};
    for (const uint8_t view : features.walls) ++num_features[view];
    for (const FeatureMatch& match : MatchWalls(features, turned, quarters, {})) {
      const auto a = static_cast<size_t>(match.a_idx), b = static_cast<size_t>(match.b_idx);
      num_right[features.walls[a]] += (features.rays[a] - turned.rays[b]).norm() < 0.01;
    }
    for (size_t k = 0; k < num_right.size(); ++k) {
      EXPECT_GT(num_right[k], num_features[k] / 2) << "view " << k << ", turn " << quarters;
    }
  }
}

// A room of points on walls and floor as two cameras see it: head-on views, true sizes.
struct MadePano {
  Gravity gravity;
  PanoFeatures features;
  std::vector<Vector3d> level_rays;
};

MadePano LookAt(const std::vector<Vector3d>& points, const DescriptorSet& descriptors,
                const Vector3d& position, double yaw_rad, double size_m) {
  MadePano pano;
  // The walls of the world run along its axes.
  pano.gravity.heading_rad = WrapQuarter(-yaw_rad);
  const Matrix3d level_from_world = RotationZ(-yaw_rad);
  const Matrix3d walls_from_level = RotationZ(-*pano.gravity.heading_rad);
  const Matrix3d cam_from_level = LevelFromCam(pano.gravity).transpose();
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector3d in_level = level_from_world * (points[i] - position);
    const Vector3d in_walls = walls_from_level * in_level;
    int view = 0;
    for (int k = 1; k < kNumWallViews; ++k) {
      if (WallViewFrame(k).col(2).dot(in_walls) > WallViewFrame(view).col(2).dot(in_walls))
        view = k;
    }
    const double depth = WallViewFrame(view).col(2).dot(in_walls);
    const double cosine = depth / in_level.norm();
    pano.features.rays.push_back((cam_from_level * in_level.normalized()).cast<float>());
    pano.features.sizes_rad.push_back(static_cast<float>(size_m / depth * cosine * cosine));
    pano.features.walls.push_back(static_cast<uint8_t>(view));
    // A quarter of the yaw turns floors in their pictures.
    const Matrix3d walls_from_world = walls_from_level * level_from_world;
    const MovedView moved = MoveView(kNumLevelWallViews, walls_from_world);
    const uint8_t* row = descriptors.row(static_cast<int>(i));
    for (int k = 0; k < kDescriptorSize; ++k) {
      pano.features.descriptors.values.push_back(
          view < kNumLevelWallViews ? row[k] : row[moved.order[static_cast<size_t>(k)]]);
    }
    pano.level_rays.push_back(in_level.normalized());
  }
  return pano;
}

TEST(MatchPair, FindsTheQuarterTurnAndTheDirection) {
  std::mt19937 random(3);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) {
    points.emplace_back(between(0, 5), 4, between(0, 2.4));
    points.emplace_back(5, between(0, 4), between(0, 2.4));
    points.emplace_back(between(1, 4), between(1, 3), 0);
  }
  const DescriptorSet descriptors =
      RandomValues(static_cast<int>(points.size()), kMaxDescriptorValue, 5);
  const Vector3d position_a(2.0, 1.5, 1.5), position_b(3.2, 2.3, 1.5);
  for (const double yaw_rad : {0.2, 1.8, -2.5, 3.0}) {
    const MadePano a = LookAt(points, descriptors, position_a, 0.4, 0.05);
    const MadePano b = LookAt(points, descriptors, position_b, 0.4 + yaw_rad, 0.05);
    const PanoPair pair = MatchPair({}, {a.features, a.gravity, a.level_rays},
                                    {b.features, b.gravity, b.level_rays}, {}, {});
    EXPECT_EQ(pair.verdict, PairVerdict::kAccepted);
    EXPECT_LT(std::abs(WrapPi(pair.Yaw_rad() - yaw_rad)), DegToRad(0.1)) << yaw_rad;
    const Vector3d direction = RotationZ(-0.4) * (position_b - position_a).normalized();
    EXPECT_LT(AngleBetween(pair.direction, direction), DegToRad(0.2)) << yaw_rad;
    EXPECT_EQ(TurnOfYaw(a.gravity, b.gravity, yaw_rad),
              TurnOfYaw(a.gravity, b.gravity, pair.Yaw_rad()));
    // A yaw that is known is the only one that is tried.
    const PanoPair other =
        MatchPair({.yaw_rad = yaw_rad + kPi / 2}, {a.features, a.gravity, a.level_rays},
                  {b.features, b.gravity, b.level_rays}, {}, {});
    EXPECT_NE(other.verdict, PairVerdict::kAccepted);
  }
}

TEST(MatchPair, DoesNotTakeWhatHasTheWrongSize) {
  std::vector<Vector3d> points;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> between(0, 1);
  for (int i = 0; i < 80; ++i) points.emplace_back(5, 4 * between(random), 2.4 * between(random));
  const DescriptorSet descriptors =
      RandomValues(static_cast<int>(points.size()), kMaxDescriptorValue, 6);
  const MadePano a = LookAt(points, descriptors, {1.0, 1.5, 1.5}, 0, 0.05);
  const MadePano b = LookAt(points, descriptors, {2.5, 2.3, 1.5}, 0, 0.05);
  const MadePano larger = LookAt(points, descriptors, {2.5, 2.3, 1.5}, 0, 0.15);
  const PanoToMatch of_a{a.features, a.gravity, a.level_rays};
  EXPECT_EQ(MatchPair({}, of_a, {b.features, b.gravity, b.level_rays}, {}, {}).verdict,
            PairVerdict::kAccepted);
  EXPECT_NE(
      MatchPair({}, of_a, {larger.features, larger.gravity, larger.level_rays}, {}, {}).verdict,
      PairVerdict::kAccepted);
}

TEST(MakeWallViews, OverlapInCorners) {
  const Camera pano = EquirectangularCamera(2048, 1024);
  const ViewRing views = MakeWallViews(pano, Matrix3d::Identity());
  ASSERT_EQ(views.pano_from_view.size(), static_cast<size_t>(kNumWallViews));
  EXPECT_EQ(views.camera.width, views.camera.height);
  int num_owners = 0;
  const Vector3d ray = Vector3d(1, 0.9, -0.2).normalized();
  for (int k = 0; k < kNumWallViews; ++k) num_owners += views.Owns(k, ray) ? 1 : 0;
  EXPECT_EQ(num_owners, 2);
}

}  // namespace
}  // namespace enfilade
