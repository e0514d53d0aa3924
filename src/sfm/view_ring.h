// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/scene/camera.h"

namespace enfilade {

/// Upright virtual views all round a panorama, in which straight lines are straight and features
/// look as in photographs.
struct ViewRing {
  Camera camera;                                ///< pinhole, the same for all views
  std::vector<Eigen::Matrix3d> pano_from_view;  ///< rotations, azimuth ascending from the centre

  /// True when view `view_idx` is the one whose axis is nearest in azimuth to the ray, which is in
  /// the panorama's camera frame: every direction belongs to exactly one view.
  /// Angle of a pixel at the centre of a view.
  [[nodiscard]] double pixel_rad() const { return 1 / camera.fx; }
  [[nodiscard]] bool Owns(int view_idx, const Eigen::Vector3d& ray_in_pano) const;
};

/// Eight views 45° apart, 60° wide and 90° high, so that each sees 7.5° more than what it owns on
/// either side; their resolution at the centre is the panorama's.
[[nodiscard]] ViewRing MakeViewRing(const Camera& pano);

}  // namespace enfilade
