// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/tracks.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// Where a made panorama was taken. With all angles 0 the picture's centre looks along +y.
struct MadeCamera {
  Eigen::Vector2d at{0, 0};
  double yaw_rad = 0;
  double height = 1;
  Eigen::Vector2d tilt_rad{0, 0};  ///< rotation vector in the level frame
};

/// Box rooms in a row along x, from y = 0 to `depth`; the floor is z = 0. Units are camera heights.
struct MadeSceneOptions {
  std::vector<double> wall_x{0, 3.2};  ///< ascending: both ends and the partitions
  std::vector<bool> is_door_open{};    ///< one a partition
  double depth = 2.6;
  double ceiling = 1.7;
  int num_points_per_room = 400;  ///< a quarter each on floor, ceiling, walls and furniture
  double seen_share = 0.7;        ///< of the points in sight that become features of a view
  double noise_rad = 0;           ///< of rays, on each of two axes
  double false_share = 0;         ///< of features, whose rays point anywhere
  double lone_share = 0;          ///< features that no other view has, as a share of the others
  double gravity_noise_rad = 0;   ///< of the verticals that are handed out, on each axis
  uint32_t seed = 1;
};

/// A scene without pictures: what a perfect or a noisy feature finder would give.
struct RegistrationScene {
  std::vector<Rigid3> world_from_cam;  ///< the truth
  std::vector<Eigen::Vector3d> points;
  std::vector<PanoFeatures> features;              ///< one a view
  std::vector<std::vector<int>> point_of_feature;  ///< as features; −1 for false and lone ones
  std::vector<Gravity> gravity;

  [[nodiscard]] int num_views() const { return static_cast<int>(features.size()); }
};

/// Points see cameras of their own room, and of others through doors (0.6 wide, 1.4 high, in the
/// middle of the partition). Descriptors are random and as good as unique.
[[nodiscard]] RegistrationScene MakeRegistrationScene(const MadeSceneOptions& options,
                                                      std::span<const MadeCamera> cameras);

/// Cameras of any yaw, two a row, evenly spread in a room from x0 to x1.
[[nodiscard]] std::vector<MadeCamera> SpreadCameras(double x0, double x1, double depth, int count,
                                                    uint32_t seed);

/// Equal rooms in a row, 3.2 wide, with the same number of cameras in each, in the order of the
/// rooms; `options` tell all but the walls and doors.
[[nodiscard]] RegistrationScene MakeRowOfRooms(MadeSceneOptions options, int num_rooms,
                                               int cameras_per_room, bool are_doors_open);

/// The features' rays in the view's level frame.
[[nodiscard]] std::vector<Eigen::Vector3d> LevelRaysOf(const RegistrationScene& scene,
                                                       int view_idx);

/// Features of two views that show one point, ascending in a_idx.
[[nodiscard]] std::vector<FeatureMatch> TrueMatches(const RegistrationScene& scene, int a_idx,
                                                    int b_idx);

/// The accepted pair as a perfect estimate gives it, with the true length.
[[nodiscard]] PanoPair TruePair(const RegistrationScene& scene, int a_idx, int b_idx);

/// One track for each point that two or more views show, at the point's true place.
[[nodiscard]] std::vector<Track> TrueTracks(const RegistrationScene& scene);

}  // namespace enfilade
