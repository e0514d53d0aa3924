// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// Fills `view_idx` of points that lack it: which views see them, ascending. Rays are cast against
/// the cloud itself: every point with a normal is a disc across it, whose radius comes from the
/// spacing of the points. A view shows a point that turns its normal to the camera and is nearest
/// along its ray, or within 10 cm of the nearest. Points without a normal are seen by none.
///
/// From each camera the discs are drawn into a sphere of distances with 0.35° a pixel (hidden
/// points after Catmull 1974), so that thin things before a wall may stay unnoticed, and what a gap
/// in the cloud shows counts as seen. The same result for any number of threads. Positions must be
/// finite and normals unit or zero. Memory: 9 MB a thread. Cost: points × views × pixels of a disc.
void FindViewsOfPoints(std::span<const View> views, std::vector<ScenePoint>& points,
                       RunContext& context);

}  // namespace enfilade
