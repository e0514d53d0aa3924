// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/image/image.h"

namespace enfilade {

/// A smooth pattern without end: waves of 15 to 45 pixels in all directions about grey level 100.
/// Its columns repeat every `period_px` pixels.
class DrawnTexture {
 public:
  explicit DrawnTexture(int seed, int period_px = 1024);

  /// Grey level at a position in pixels, about 20 to 180.
  [[nodiscard]] double At(const Eigen::Vector2d& position) const;

  /// Picture whose pixel at p shows gain · At(p − shift), rounded to 8 bits and clipped.
  [[nodiscard]] ImageU8 Draw(int rows, int cols, const Eigen::Vector2d& shift = {0, 0},
                             double gain = 1) const;

 private:
  struct Wave {
    Eigen::Vector2d frequency;
    double phase, amplitude;
  };
  std::vector<Wave> waves_;
};

}  // namespace enfilade
