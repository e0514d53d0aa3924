// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/scene/camera.h"

namespace enfilade {

/// Virtual views of a panorama, in which straight lines are straight and features look as in
/// photographs.
struct ViewRing {
  Camera camera;                                ///< pinhole, the same for all views
  std::vector<Eigen::Matrix3d> pano_from_view;  ///< rotations
  /// What a view owns: rays so far off its axis to either side, as tangents. The rest is there for
  /// what reaches over the border.
  double owned_x = 0, owned_y = 0;

  /// Angle of a pixel at the centre of a view.
  [[nodiscard]] double pixel_rad() const { return 1 / camera.fx; }
  /// `ray_in_pano` is in the panorama's camera frame.
  [[nodiscard]] bool Owns(int view_idx, const Eigen::Vector3d& ray_in_pano) const;
};

/// Eight upright views about the panorama's own axes, azimuth ascending from the centre by 45°, 60°
/// wide and 90° high, each of which owns what is nearest to it; their resolution at the centre is
/// the panorama's.
[[nodiscard]] ViewRing MakeViewRing(const Camera& pano);

/// Four level views along the walls of a room, one of its floor and one of its ceiling
/// (WallViewFrame), 124° wide and high. A plane that is parallel to a view's has the same picture
/// from everywhere but for shift and scale, however much from aside it is seen, as with the
/// viewpoint invariant patches of Wu et al. (CVPR 2008); so the views overlap, and each owns 60° to
/// all sides. `pano_from_walls` turns a frame with z up and the walls along its axes.
[[nodiscard]] ViewRing MakeWallViews(const Camera& pano, const Eigen::Matrix3d& pano_from_walls);

}  // namespace enfilade
