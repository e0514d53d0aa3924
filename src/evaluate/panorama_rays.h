// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "enfilade/scene/camera.h"

namespace enfilade {

/// Unit rays through the pixel centres of an equirectangular panorama, in the camera's frame: those
/// of Camera::RayFromPixel without its trigonometry for every pixel.
class PanoramaRays {
 public:
  PanoramaRays(int rows, int cols) {
    const Camera camera = EquirectangularCamera(cols, rows);
    for (int col = 0; col < cols; ++col) {
      const Eigen::Vector3d ray = camera.RayFromPixel({col + 0.5, 0.5 * rows});
      level_of_col_.emplace_back(ray.x(), ray.z());
    }
    for (int row = 0; row < rows; ++row) {
      const double down = camera.RayFromPixel({0.5, row + 0.5}).y();
      down_of_row_.emplace_back(std::sqrt(1 - down * down), down);
    }
  }

  [[nodiscard]] Eigen::Vector3d operator()(int row, int col) const {
    const Eigen::Vector2d& level = level_of_col_[static_cast<size_t>(col)];
    const Eigen::Vector2d& upright = down_of_row_[static_cast<size_t>(row)];
    return {upright.x() * level.x(), upright.y(), upright.x() * level.y()};
  }

 private:
  std::vector<Eigen::Vector2d> level_of_col_;  // x and z at the horizon
  std::vector<Eigen::Vector2d> down_of_row_;   // horizontal length, y
};

}  // namespace enfilade
