// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// Frames of a rendered walk through a furnished flat, with the truth about their motion.
struct RenderedFilm {
  struct Frame {
    ImageU8 rgb;
    ImageF range_m;
    Rigid3 home_from_cam;
  };
  Camera camera;
  std::vector<Frame> frames;

  /// Where the surface point seen at `position_px` of a frame is in another. None where it is
  /// hidden or outside there, and within a pixel of an edge of depth.
  [[nodiscard]] std::optional<Eigen::Vector2d> Follow(int from, int to,
                                                      const Eigen::Vector2d& position_px) const;
};

/// The first `num_frames` frames at 30 a second (0.8 m/s), 540 × 360 pixels and 57° wide, looking
/// 30° to the left of the way; or panoramas of 1024 × 512 pixels.
[[nodiscard]] RenderedFilm RenderFilm(int seed, int num_frames, CameraModel model);

/// The picture with all values times `gain`, rounded and clipped to 8 bits.
[[nodiscard]] ImageU8 TimesGain(const ImageU8& image, double gain);

}  // namespace enfilade
