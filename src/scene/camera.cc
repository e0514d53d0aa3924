// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/camera.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d Camera::RayFromPixel(const Vector2d& pixel) const {
  if (model == CameraModel::kPinhole) {
    return Vector3d((pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0).normalized();
  }
  const double theta = 2 * kPi * (pixel.x() / width - 0.5);
  const double phi = kPi * (0.5 - pixel.y() / height);
  return {std::cos(phi) * std::sin(theta), -std::sin(phi), std::cos(phi) * std::cos(theta)};
}

std::optional<Vector2d> Camera::PixelFromRay(const Vector3d& ray) const {
  if (model == CameraModel::kPinhole) {
    if (ray.z() <= 0) return std::nullopt;
    const Vector2d pixel(fx * ray.x() / ray.z() + cx, fy * ray.y() / ray.z() + cy);
    if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= width || pixel.y() >= height)
      return std::nullopt;
    return pixel;
  }
  const double theta = std::atan2(ray.x(), ray.z());
  const double phi = -std::atan2(ray.y(), std::hypot(ray.x(), ray.z()));
  double x = width * (theta / (2 * kPi) + 0.5);
  if (x >= width) x -= width;
  return Vector2d(x, height * (0.5 - phi / kPi));
}

Camera EquirectangularCamera(int width, int height) {
  ENFILADE_CHECK(width > 0 && height > 0);
  return {CameraModel::kEquirectangular, width, height, 0, 0, 0, 0};
}

Camera PinholeCamera(int width, int height, double fx, double fy, double cx, double cy) {
  ENFILADE_CHECK(width > 0 && height > 0 && fx > 0 && fy > 0);
  return {CameraModel::kPinhole, width, height, fx, fy, cx, cy};
}

}  // namespace enfilade
