// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/wall_matches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/gravity.h"

namespace enfilade {
namespace {

constexpr double kQuarter_rad = kPi / 2;

// The descriptors of each wall view and whose they are.
struct WallDescriptors {
  DescriptorSet descriptors;
  std::vector<int> feature_idx;
};

// By views of the frame that `moved_from_frame` makes of the features' own.
std::array<WallDescriptors, kNumWallViews> DivideByWalls(const PanoFeatures& features,
                                                         const Eigen::Matrix3d& moved_from_frame) {
  const std::array<MovedView, kNumWallViews> moved = MoveViews(moved_from_frame);
  std::array<WallDescriptors, kNumWallViews> walls;
  for (int i = 0; i < features.descriptors.size(); ++i) {
    const MovedView& to = moved[features.walls[static_cast<size_t>(i)]];
    WallDescriptors& wall = walls[static_cast<size_t>(to.view)];
    const uint8_t* row = features.descriptors.row(i);
    for (const uint8_t from : to.order) wall.descriptors.values.push_back(row[from]);
    wall.feature_idx.push_back(i);
  }
  return walls;
}

bool KnowsWalls(const PanoFeatures& features, const Gravity& gravity) {
  return gravity.heading_rad &&
         features.walls.size() == static_cast<size_t>(features.descriptors.size());
}

}  // namespace

Eigen::Matrix3d CamFromWalls(const Gravity& gravity) {
  return LevelFromCam(gravity).transpose() * RotationZ(gravity.heading_rad.value_or(0));
}

std::optional<double> YawOfTurn(const PanoFeatures& a, const Gravity& gravity_a,
                                const PanoFeatures& b, const Gravity& gravity_b, int turn) {
  if (!KnowsWalls(a, gravity_a) || !KnowsWalls(b, gravity_b)) return std::nullopt;
  return WrapPi(*gravity_a.heading_rad - *gravity_b.heading_rad - turn * kQuarter_rad);
}

int TurnOfYaw(const Gravity& gravity_a, const Gravity& gravity_b, double yaw_rad) {
  const double turned = gravity_a.heading_rad.value_or(0) - gravity_b.heading_rad.value_or(0);
  const int turn = static_cast<int>(std::lround((turned - yaw_rad) / kQuarter_rad));
  return (turn % kNumTurns + kNumTurns) % kNumTurns;
}

std::vector<FeatureMatch> MatchWalls(const PanoFeatures& a, const PanoFeatures& b, int turn,
                                     const DescriptorMatchOptions& options) {
  // Yaw of b's wall frame in a's.
  const Eigen::Matrix3d a_from_b = RotationZ(-turn * kQuarter_rad);
  const auto walls_a = DivideByWalls(a, Eigen::Matrix3d::Identity());
  const auto walls_b = DivideByWalls(b, a_from_b);
  std::vector<FeatureMatch> matches;
  for (int k = 0; k < kNumWallViews; ++k) {
    const WallDescriptors& of_a = walls_a[static_cast<size_t>(k)];
    const WallDescriptors& of_b = walls_b[static_cast<size_t>(k)];
    for (const FeatureMatch& match :
         MatchDescriptors(of_a.descriptors, of_b.descriptors, options)) {
      matches.push_back({of_a.feature_idx[static_cast<size_t>(match.a_idx)],
                         of_b.feature_idx[static_cast<size_t>(match.b_idx)], match.ratio});
    }
  }
  std::sort(matches.begin(), matches.end(),
            [](const FeatureMatch& x, const FeatureMatch& y) { return x.a_idx < y.a_idx; });
  return matches;
}

std::vector<FeatureMatch> MatchAtYaw(const PanoFeatures& a, const Gravity& gravity_a,
                                     const PanoFeatures& b, const Gravity& gravity_b,
                                     double yaw_rad, const DescriptorMatchOptions& options) {
  if (!KnowsWalls(a, gravity_a) || !KnowsWalls(b, gravity_b)) {
    return MatchDescriptors(a.descriptors, b.descriptors, options);
  }
  return MatchWalls(a, b, TurnOfYaw(gravity_a, gravity_b, yaw_rad), options);
}

std::vector<double> LogSizes(const PanoFeatures& features,
                             std::span<const Eigen::Vector3d> level_rays, const Gravity& gravity) {
  std::vector<double> log_sizes;
  const bool is_head_on = KnowsWalls(features, gravity);
  std::array<Eigen::Vector3d, kNumWallViews> axes;
  for (size_t k = 0; k < axes.size(); ++k) {
    axes[k] =
        RotationZ(gravity.heading_rad.value_or(0)) * WallViewFrame(static_cast<int>(k)).col(2);
  }
  for (size_t i = 0; i < features.sizes_rad.size(); ++i) {
    const double cosine = is_head_on ? axes[features.walls[i]].dot(level_rays[i]) : 1;
    log_sizes.push_back(std::log(features.sizes_rad[i] / cosine));
  }
  return log_sizes;
}

}  // namespace enfilade
