// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "enfilade/geometry/rigid3.h"

namespace enfilade {

/// The unit of the made scenes is the camera's height; errors in metres are told for this one.
inline constexpr double kCameraHeight_m = 1.5;

[[nodiscard]] double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
/// Angle of the rotation between two rotations.
[[nodiscard]] double TurnBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

struct PoseErrors {
  double position = 0;      ///< largest distance, camera heights
  double rotation_rad = 0;  ///< largest angle
};

/// Largest errors of some views once the estimate was turned about z and moved in the level plane,
/// but not scaled, so that it fits best.
[[nodiscard]] PoseErrors ComparePoses(std::span<const Rigid3> estimate,
                                      std::span<const Rigid3> truth, std::span<const int> views);
/// Of all views.
[[nodiscard]] PoseErrors ComparePoses(std::span<const Rigid3> estimate,
                                      std::span<const Rigid3> truth);

}  // namespace enfilade
