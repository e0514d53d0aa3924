// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

namespace enfilade {

enum class CameraModel { kEquirectangular, kPinhole };

/// Intrinsics of one picture. Camera frame: x right, y down, z forward; pixel (0.5, 0.5) is the
/// centre of the top-left pixel.
///
/// Equirectangular (COLMAP 4): ray = (cos φ sin θ, −sin φ, cos φ cos θ), θ = 2π(x/W − ½),
/// φ = π(½ − y/H). Pinhole: fx, fy, cx, cy in pixels.
struct Camera {
  CameraModel model = CameraModel::kEquirectangular;
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pinhole only

  /// Unit ray through a pixel.
  [[nodiscard]] Eigen::Vector3d RayFromPixel(const Eigen::Vector2d& pixel) const;
  /// Pixel of a point or ray, none when a pinhole camera has it behind or outside its picture.
  [[nodiscard]] std::optional<Eigen::Vector2d> PixelFromRay(const Eigen::Vector3d& ray) const;
};

[[nodiscard]] Camera EquirectangularCamera(int width, int height);
[[nodiscard]] Camera PinholeCamera(int width, int height, double fx, double fy, double cx,
                                   double cy);

}  // namespace enfilade
