// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "enfilade/sfm/descriptor_matcher.h"

namespace enfilade {

/// Views of a room along the axes of a frame with z up: 0 … 3 look along the azimuths 0, 90°, 180°
/// and 270°, upright; 4 looks down and 5 up, both with the top of the picture along +x.
inline constexpr int kNumWallViews = 6;
inline constexpr int kNumLevelWallViews = 4;
inline constexpr int kFloorWallView = 4;

/// The view's axes (right, down, forward) in that frame as columns.
[[nodiscard]] Eigen::Matrix3d WallViewFrame(int view);

/// What a turn of the frame, or a reflection, does to a view: the view that shows then what this
/// one showed, and how SIFT describes it there (upright: 4 rows and columns of 8 angles that grow
/// anticlockwise). Exact, as pictures of such views are turned by quarters or mirrored. (For
/// mirrored ones Guo et al., MIFT: A Mirror Reflection Invariant Feature Descriptor, ACCV 2009.)
struct MovedView {
  int view = 0;
  std::array<uint8_t, kDescriptorSize> order{};  ///< value i was value order[i] before
};
/// `moved_from_frame` maps axes to axes.
[[nodiscard]] MovedView MoveView(int view, const Eigen::Matrix3d& moved_from_frame);
/// MoveView of all views.
[[nodiscard]] std::array<MovedView, kNumWallViews> MoveViews(
    const Eigen::Matrix3d& moved_from_frame);

}  // namespace enfilade
