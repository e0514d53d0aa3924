// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

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

}  // namespace enfilade
