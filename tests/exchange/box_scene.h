// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/scene/types.h"

namespace enfilade {

/// A room of 6 × 4 × 2.5 m, six panoramas of 2048 × 1024 pixels in it that stand nearly upright and
/// look all ways, and 300 points on its six sides, all of which every panorama sees.
struct BoxSceneOptions {
  double pixel_sigma = 0;       ///< of the observations, each coordinate, normal
  double position_sigma_m = 0;  ///< of the points and the cameras
};
[[nodiscard]] Scene MakeBoxScene(const BoxSceneOptions& options = {});

}  // namespace enfilade
