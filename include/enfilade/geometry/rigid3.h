// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace enfilade {

/// Rigid transform named target_from_source: x_in_target = rotation · x_in_source + translation.
struct Rigid3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return rotation * x + translation;
  }
  /// a_from_b * b_from_c = a_from_c.
  [[nodiscard]] Rigid3 operator*(const Rigid3& other) const {
    return {rotation * other.rotation, rotation * other.translation + translation};
  }
  [[nodiscard]] Rigid3 Inverse() const {
    return {rotation.transpose(), -(rotation.transpose() * translation)};
  }
  [[nodiscard]] Eigen::Matrix4d Matrix() const {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.topLeftCorner<3, 3>() = rotation;
    m.topRightCorner<3, 1>() = translation;
    return m;
  }
};

/// The turn about +z in a rotation, radians in (−π, π]: its twist (swing-twist decomposition).
[[nodiscard]] inline double YawOf(const Eigen::Matrix3d& rotation) {
  return std::atan2(rotation(1, 0) - rotation(0, 1), rotation(0, 0) + rotation(1, 1));
}

/// Rotation about +z by `rad`, counter-clockwise seen from above.
[[nodiscard]] inline Eigen::Matrix3d RotationZ(double rad) {
  return Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// The rotation nearest to `m` in the Frobenius norm (orthogonal Procrustes): for matrices read
/// from files whose entries were rounded.
[[nodiscard]] inline Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

}  // namespace enfilade
