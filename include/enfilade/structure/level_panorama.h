// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <utility>

#include "enfilade/base/run_context.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// A picture turned upright and into a frame with known heading, so that every column is one
/// azimuth and vertical lines of the home stay within one column.
///
/// Pixel (row, col) of a width × width/2 picture looks along azimuth AzimuthOfColumn(col, width),
/// counter-clockwise from the frame's +x, and elevation π(½ − (row + ½)/rows).
struct LevelPanorama {
  Eigen::Vector3d position{0, 0, 0};  ///< of the camera, in the frame
  ImageU8 rgb;                        ///< rows × 2·rows × 3
  ImageU8 is_seen;  ///< rows × 2·rows: 0 outside the picture, its mask or the stand

  [[nodiscard]] int rows() const { return rgb.rows(); }
  [[nodiscard]] int cols() const { return rgb.cols(); }
  /// Continuous row (0.5 is the centre of the top row) of an elevation.
  [[nodiscard]] double RowOfElevation(double elevation_rad) const;
};

/// The pixels of a level panorama of any size and their directions in its frame.
struct LevelPixels {
  int rows = 0, cols = 0;

  /// Unit vector through the centre of a pixel.
  [[nodiscard]] Eigen::Vector3d Direction(int row, int col) const;
  /// Row and column of the pixel that a unit vector goes through.
  [[nodiscard]] std::pair<int, int> At(const Eigen::Vector3d& direction) const;
};

/// Resamples `picture` (rows × cols × 3, the decoded file of `view`) into the frame
/// frame_from_world. `width` is the width of the result; pictures with a finer resolution are
/// averaged first. Pixels below `stand_elevation_rad` count as unseen.
[[nodiscard]] LevelPanorama MakeLevelPanorama(const View& view, const ImageU8& picture,
                                              const Rigid3& frame_from_world, int width,
                                              double stand_elevation_rad);

/// Width at which a picture keeps its angular resolution, at most `max_width`, even.
[[nodiscard]] int LevelWidth(const View& view, int max_width);

}  // namespace enfilade
