// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "enfilade/image/codec.h"

namespace enfilade {

/// What a panorama's XMP metadata tell (Google, Photo Sphere XMP Metadata, namespace GPano).
/// Members are none where the tag is absent or no number in its range.
struct PhotoSphere {
  std::optional<double> pitch_deg;        ///< of the picture's centre above the horizon
  std::optional<double> roll_deg;         ///< the horizon turns counter-clockwise as it grows
  std::optional<ImageSize> full_size;     ///< of the whole panorama, pixels
  std::optional<ImageSize> cropped_size;  ///< of the part that the picture holds, pixels

  /// Upward in the camera frame, unit; none where neither pitch nor roll is told.
  [[nodiscard]] std::optional<Eigen::Vector3d> UpInCam() const;

  /// True where the tags say that a picture of this size holds a part of the panorama only. Tags
  /// that tell another shape than the picture has belong to what it was made from and do not count.
  [[nodiscard]] bool IsCropped(const ImageSize& picture) const;
};

/// Reads an XMP packet (UTF-8). Broken XML or none gives a PhotoSphere without members.
[[nodiscard]] PhotoSphere ParsePhotoSphere(const std::string& xmp_packet);

}  // namespace enfilade
