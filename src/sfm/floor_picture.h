// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// The floor about a panorama as seen from straight above: square, the camera over the middle of
/// the middle pixel, the top along the heading (WallViewFrame). Of what stands on the floor it
/// shows what hides the floor.
struct FloorPicture {
  static constexpr int kReach = 200;              ///< pixels from the middle to the border
  static constexpr int kSide = 2 * kReach + 1;    ///< pixels
  static constexpr double kPixelsPerHeight = 75;  ///< pixels a camera height
  static constexpr double kNearest = 22.5;        ///< pixels; the camera's stand is nearer
  static constexpr double kScale = 32;            ///< of the values

  /// kSide × kSide: brightness less its mean nearby, over its standard deviation nearby, times
  /// kScale; 0 where nothing is known. Empty: the panorama has no known heading.
  Image<int8_t> contrast;

  /// Whether all panoramas show the floor there: on the disc about the camera, not under its stand.
  [[nodiscard]] static bool IsShown(int row, int col);
};

/// `panorama` is rows × 2·rows × 3 or × 1 of the size that `camera` (equirectangular) tells,
/// `trusted` as large (0 = ignore); `pano_from_walls` turns into the camera frame a frame with z up
/// and the walls along its axes.
[[nodiscard]] FloorPicture LookAtFloor(const ImageU8& panorama, const ImageU8& trusted,
                                       const Camera& camera,
                                       const Eigen::Matrix3d& pano_from_walls);

}  // namespace enfilade
