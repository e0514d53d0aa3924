// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "enfilade/exchange/connection_report.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"

namespace enfilade {

/// A scene with what registration tells of it, for reports.
struct ReportedScene {
  Scene scene;
  std::vector<PanoPair> pairs;
  std::vector<int> num_features;
  std::vector<std::string> warnings;

  [[nodiscard]] ConnectionReport Report() const {
    ConnectionReport report;
    report.pairs = pairs;
    report.num_features = num_features;
    report.warnings = warnings;
    return report;
  }
};

/// A level camera whose picture's centre looks along azimuth `yaw_rad`.
inline Rigid3 LevelCamera(const Eigen::Vector3d& position, double yaw_rad) {
  const Eigen::Matrix3d level_from_cam = LevelFromCam(Gravity{});
  return {RotationZ(yaw_rad - kPi / 2) * level_from_cam, position};
}

inline void AddView(ReportedScene& reported, const std::string& picture, int component,
                    const Eigen::Vector3d& position, double yaw_rad, int num_features = 4000) {
  View view;
  view.picture = picture;
  view.component_idx = component;
  view.world_from_cam = LevelCamera(position, yaw_rad);
  reported.scene.views.push_back(view);
  reported.num_features.push_back(num_features);
}

/// Appends the pair as exact geometry gives it (in a component of its own each view stands where
/// the scene says, whatever that means); the parallax is made up.
inline PanoPair& AddPair(ReportedScene& reported, int a, int b, PairVerdict verdict,
                         int num_matches, int num_inliers) {
  const Rigid3& pose_a = reported.scene.views[static_cast<size_t>(a)].world_from_cam;
  const Rigid3& pose_b = reported.scene.views[static_cast<size_t>(b)].world_from_cam;
  const Eigen::Matrix3d level_from_cam = LevelFromCam(Gravity{});
  const Eigen::Matrix3d level_a_from_world = level_from_cam * pose_a.rotation.transpose();
  PanoPair pair;
  pair.a_idx = a;
  pair.b_idx = b;
  pair.verdict = verdict;
  pair.num_matches = num_matches;
  for (int i = 0; i < num_inliers; ++i) pair.inliers.push_back({i, i});
  pair.a_from_b = level_a_from_world * pose_b.rotation * level_from_cam.transpose();
  const Eigen::Vector3d apart = pose_b.translation - pose_a.translation;
  if (apart.norm() > 0) pair.direction = level_a_from_world * apart.normalized();
  pair.log10_chance = verdict == PairVerdict::kAccepted ? -0.4 * num_inliers : -0.5;
  pair.parallax_rad = DegToRad(12);
  reported.pairs.push_back(pair);
  return reported.pairs.back();
}

/// Hall and kitchen, 5 m apart, are tied; the attic is not. Five points, one metre apart along x.
inline ReportedScene MakeThreeRooms() {
  ReportedScene reported;
  AddView(reported, "hall.jpg", 0, {1, 2, 1.5}, DegToRad(90), 3000);
  AddView(reported, "kitchen.jpg", 0, {4, 6, 1.5}, DegToRad(-30), 2500);
  AddView(reported, "attic.jpg", 1, {0, 0, 1.5}, 0, 800);
  AddPair(reported, 0, 1, PairVerdict::kAccepted, 120, 60);
  AddPair(reported, 0, 2, PairVerdict::kChance, 30, 9);
  AddPair(reported, 1, 2, PairVerdict::kFewMatches, 7, 0);
  for (int i = 0; i < 5; ++i) {
    ScenePoint point;
    point.position = {1.0 + i, 3.0, 1.0};
    point.view_idx = i < 2 ? std::vector{0, 1} : std::vector{1};
    reported.scene.points.push_back(point);
  }
  return reported;
}

/// Numbers that are the same with every standard library.
class UniformNumbers {
 public:
  explicit UniformNumbers(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }

 private:
  std::mt19937 random_;
};

inline constexpr double kReportedRoom_m = 3.2;

/// Points on the walls of a square room.
inline void AddWallPoints(ReportedScene& reported, int view_idx, const Eigen::Vector3d& corner,
                          UniformNumbers& uniform) {
  for (int k = 0; k < 260; ++k) {
    const double along = uniform(0, kReportedRoom_m);
    const double across =
        (uniform(0, 1) < 0.5 ? kReportedRoom_m - 0.1 : 0.1) + uniform(-0.02, 0.02);
    const bool is_x = uniform(0, 1) < 0.5;
    ScenePoint point;
    point.position =
        corner + Eigen::Vector3d(is_x ? along : across, is_x ? across : along, uniform(0, 2.5));
    point.view_idx = {view_idx};
    reported.scene.points.push_back(point);
  }
}

/// A component of `size` views, one somewhere in every room of a block of square rooms.
inline void AddBlock(ReportedScene& reported, int component, int size, UniformNumbers& uniform) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(1.6 * size)));
  for (int i = 0; i < size; ++i) {
    const Eigen::Vector3d corner(kReportedRoom_m * (i % columns), kReportedRoom_m * (i / columns),
                                 0);
    const int view_idx = static_cast<int>(reported.scene.views.size());
    const double x = uniform(0.7, 2.5), y = uniform(0.7, 2.5);
    AddView(reported, fmt::format("floor_01_room_{:02}_pano_{}.jpg", i, view_idx), component,
            corner + Eigen::Vector3d(x, y, 1.5), uniform(-kPi, kPi),
            static_cast<int>(uniform(2500, 6000)));
    if (size > 1) AddWallPoints(reported, view_idx, corner, uniform);
  }
}

/// A tie between neighbours, else now and then a contradiction, mostly nothing of note.
inline void AddLikelyPair(ReportedScene& reported, int a, int b, UniformNumbers& uniform) {
  constexpr double kReach_m = 5.5;
  const View& view_a = reported.scene.views[static_cast<size_t>(a)];
  const View& view_b = reported.scene.views[static_cast<size_t>(b)];
  const double distance =
      (view_a.world_from_cam.translation - view_b.world_from_cam.translation).norm();
  const int num_matches = static_cast<int>(uniform(4, 60));
  if (view_a.component_idx == view_b.component_idx && distance < kReach_m) {
    const int num_inliers = static_cast<int>(uniform(0.6, 1.4) * 420 / (distance * distance));
    AddPair(reported, a, b, PairVerdict::kAccepted, 2 * num_inliers + num_matches, 8 + num_inliers);
  } else if (uniform(0, 1) < 0.03) {
    const bool is_turn = uniform(0, 1) < 0.5;
    AddPair(reported, a, b,
            is_turn ? PairVerdict::kAgainstTriplets : PairVerdict::kAgainstPositions,
            num_matches + 10, 9 + num_matches / 4);
  } else if (uniform(0, 1) < 0.6) {
    AddPair(reported, a, b, PairVerdict::kChance, num_matches, num_matches / 5);
  } else {
    AddPair(reported, a, b, PairVerdict::kFewMatches, num_matches / 6, 0);
  }
}

/// Blocks of rooms, one a component, with points on the walls, ties between neighbours and refused
/// pairs of all kinds.
inline ReportedScene MakeReportedScene(const std::vector<int>& sizes, unsigned seed = 1) {
  ReportedScene reported;
  UniformNumbers uniform(seed);
  for (size_t i = 0; i < sizes.size(); ++i) {
    AddBlock(reported, static_cast<int>(i), sizes[i], uniform);
  }
  const int num_views = static_cast<int>(reported.scene.views.size());
  for (int a = 0; a < num_views; ++a) {
    for (int b = a + 1; b < num_views; ++b) AddLikelyPair(reported, a, b, uniform);
  }
  return reported;
}

}  // namespace enfilade
