// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// Redraws runs of axis-parallel rings, which have the rooms inside, as straight oblique walls
/// where a straight face is seen there and the ring becomes cheaper: the costs are those of the
/// loop, and heading_cost_m for a heading off the axes. Round walls become polylines. Rings on
/// which nothing is gained stay as they are to the bit. Evidence of raw counts draws none.
///
/// Walls are chords between two points of the ring, which lies within half a metre of them. Each is
/// turned and shifted to the evidence, and to 45° if that is near; the cheapest closed sequence of
/// chords and stretches of the ring is found by dynamic programming over the points. Then the walls
/// are prolonged to where they meet. Cost O(points² · corners) a ring, and a few thousand samples
/// for each chord that saves something.
void DrawObliqueWalls(const LoopField& field, const FloorplanOptions& options, RunContext& context,
                      std::vector<Polygon2>& polygons);

}  // namespace enfilade
