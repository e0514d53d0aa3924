// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/gravity.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// The features' rays in the panorama's level frame.
[[nodiscard]] inline std::vector<Eigen::Vector3d> TurnLevel(const PanoFeatures& features,
                                                            const Gravity& gravity) {
  const Eigen::Matrix3d level_from_cam = LevelFromCam(gravity);
  std::vector<Eigen::Vector3d> level;
  for (const Eigen::Vector3f& ray : features.rays) {
    level.push_back(level_from_cam * ray.cast<double>());
  }
  return level;
}

/// The yaw between two panoramas modulo 90° as their walls tell it.
[[nodiscard]] inline std::optional<double> HeadingDifference(const Gravity& a, const Gravity& b) {
  if (!a.heading_rad || !b.heading_rad) return std::nullopt;
  return *a.heading_rad - *b.heading_rad;
}

/// How two panoramas stand to each other by their poses, in their level frames.
inline void SetGeometry(const Rigid3& pose_a, const Rigid3& pose_b, const Gravity& gravity_a,
                        const Gravity& gravity_b, PanoPair& pair) {
  const Eigen::Matrix3d a_from_world = LevelFromCam(gravity_a) * pose_a.rotation.transpose();
  pair.a_from_b = a_from_world * pose_b.rotation * LevelFromCam(gravity_b).transpose();
  pair.direction = (a_from_world * (pose_b.translation - pose_a.translation)).normalized();
}

/// The yaw of b in a's level frame by their poses.
[[nodiscard]] inline double YawBetween(const Rigid3& pose_a, const Rigid3& pose_b,
                                       const Gravity& gravity_a, const Gravity& gravity_b) {
  PanoPair standing;
  SetGeometry(pose_a, pose_b, gravity_a, gravity_b, standing);
  return standing.Yaw_rad();
}

}  // namespace enfilade
