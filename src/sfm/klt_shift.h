// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "enfilade/sfm/gray_pyramid.h"

namespace enfilade {

/// The shift of the whole picture from one frame to the next, in pixels of level 0: where turns of
/// the camera take most features. Exhaustive search for the best correlation of thumbnails at most
/// 64 pixels wide, which does not care about gains (the small blurry images of Klein and Murray,
/// ECCV 2008, with a shift instead of a rotation). Up to a third of the width (all round where the
/// pictures wrap) and a quarter of the height; to about half a pixel of a thumbnail. Zero where no
/// shift is clearly better than none.
[[nodiscard]] Eigen::Vector2d ShiftOfPicture(const GrayPyramid& first, const GrayPyramid& second);

}  // namespace enfilade
