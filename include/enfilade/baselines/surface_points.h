// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// Fewer oriented points than this make no surface.
inline constexpr size_t kMinSurfacePoints = 100;

/// Oriented points in the world, each with the views that see it: what the rivals in three
/// dimensions are given.
///
/// The scene's own cloud where it has at least kMinSurfacePoints points with finite position, unit
/// normal and a view. Else what structure found: from each panorama rays as close as the pixels of
/// a picture of 512 × 256, evenly over the sphere, end at its wall profile, its floor or its
/// ceiling. There the normal of a wall is that of the straightest chord of the profile through its
/// column or on either side of it. Normals look at the camera.
///
/// Requires one profile a view. In the order of the points, else of the views; the same for any
/// number of threads.
[[nodiscard]] std::vector<ScenePoint> SurfacePoints(const Scene& scene, const Structure& structure,
                                                    RunContext& context);

}  // namespace enfilade
