// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/sfm/pose_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

namespace enfilade {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double TurnBetween(const Matrix3d& a, const Matrix3d& b) {
  return Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b));
}

PoseErrors ComparePoses(std::span<const Rigid3> estimate, std::span<const Rigid3> truth,
                        std::span<const int> views) {
  Vector3d mean_estimate = Vector3d::Zero(), mean_truth = Vector3d::Zero();
  for (const int view : views) {
    mean_estimate += estimate[static_cast<size_t>(view)].translation;
    mean_truth += truth[static_cast<size_t>(view)].translation;
  }
  mean_estimate /= static_cast<double>(views.size());
  mean_truth /= static_cast<double>(views.size());
  std::complex<double> turn = 0;
  for (const int view : views) {
    const Vector3d from = estimate[static_cast<size_t>(view)].translation - mean_estimate;
    const Vector3d to = truth[static_cast<size_t>(view)].translation - mean_truth;
    turn += std::complex(to.x(), to.y()) * std::conj(std::complex(from.x(), from.y()));
    const Matrix3d rotation = truth[static_cast<size_t>(view)].rotation *
                              estimate[static_cast<size_t>(view)].rotation.transpose();
    turn += std::complex(rotation(0, 0), rotation(1, 0));
  }
  const Matrix3d world_from_estimate = RotationZ(std::arg(turn));
  Vector3d offset = mean_truth - world_from_estimate * mean_estimate;
  offset.z() = 0;  // the floor is z = 0 in both
  PoseErrors errors;
  for (const int view : views) {
    const Rigid3& from = estimate[static_cast<size_t>(view)];
    const Rigid3& to = truth[static_cast<size_t>(view)];
    const Vector3d moved = world_from_estimate * from.translation + offset;
    errors.position = std::max(errors.position, (moved - to.translation).norm());
    errors.rotation_rad = std::max(errors.rotation_rad,
                                   TurnBetween(world_from_estimate * from.rotation, to.rotation));
  }
  return errors;
}

PoseErrors ComparePoses(std::span<const Rigid3> estimate, std::span<const Rigid3> truth) {
  std::vector<int> views(truth.size());
  std::iota(views.begin(), views.end(), 0);
  return ComparePoses(estimate, truth, views);
}

}  // namespace enfilade
