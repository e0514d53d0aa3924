// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "enfilade/sfm/gray_pyramid.h"
#include "src/sfm/klt_gain.h"

namespace enfilade {

/// The window of the first frame holds four planes of size × size values: grey level, its gradient
/// along x and y, and 1; all but the first are 0 for pixels that are clipped or outside the
/// picture.
inline constexpr int kNumWindowPlanes = 4;

/// Grey levels from here on count as clipped.
inline constexpr float kClippedGray = 254.0f;

struct WindowSums {
  GainBlock block;       ///< without the tensor, which does not change with displacement and gain
  double residual2 = 0;  ///< Σ e²
};

/// The innermost loops of tracking for one size of windows. Positions are in pixels of the level
/// and lie within the picture; windows may hang over its edge.
///
/// Residuals e = I₂ / gain − I₁ are in grey levels of the first frame, so that the planes serve for
/// all gains; where the gain clips a pixel, I₂ is compared with the clipped value.
struct WindowKernel {
  /// Fills the planes of the window round `position`; returns its tensor Σ g gᵀ.
  Eigen::Matrix2d (*cut)(const GrayLevel& level, const Eigen::Vector2d& position, float* planes);
  /// Σ g e with the window of the second frame at `position`.
  Eigen::Vector2d (*gradient_residual)(const GrayLevel& level, const Eigen::Vector2d& position,
                                       float inverse_gain, const float* planes);
  /// All sums; those of the gain are over the pixels that it does not clip.
  WindowSums (*sums)(const GrayLevel& level, const Eigen::Vector2d& position, float inverse_gain,
                     const float* planes);
};

/// `window_px` is 8, 12, 16, 20 or 24.
[[nodiscard]] const WindowKernel& KernelOfWindow(int window_px);

}  // namespace enfilade
