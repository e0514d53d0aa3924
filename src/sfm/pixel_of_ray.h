// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// The first channel of the pixel of a panorama that a ray goes through; the others follow it.
/// `panorama` must have the size of `camera`, which is equirectangular.
[[nodiscard]] inline const uint8_t* PixelOfRay(const ImageU8& panorama, const Camera& camera,
                                               const Eigen::Vector3d& ray) {
  const Eigen::Vector2d pixel = *camera.PixelFromRay(ray);
  const int row = std::clamp(static_cast<int>(pixel.y()), 0, panorama.rows() - 1);
  const int col = std::clamp(static_cast<int>(pixel.x()), 0, panorama.cols() - 1);
  return &panorama(row, col);
}

}  // namespace enfilade
