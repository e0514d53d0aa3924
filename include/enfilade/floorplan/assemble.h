// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// The plan with these polygons as rooms, `rooms[i]` those of storey i, made into rooms and walls
/// as SolveFloorplan makes its own: heights from the profiles inside, walls the edges, each with
/// how well the evidence shows it. The polygons stay as they are. No openings.
///
/// `rooms` and `evidence` have one entry a storey of `structure`. Of `options` only what concerns
/// walls counts: seen_wall_log_odds or paper, wall_thickness_m, openings.max_wall_m and, as reach
/// across a wall, slide_m.
[[nodiscard]] Floorplan AssembleFloorplan(const Scene& scene, const Structure& structure,
                                          const std::vector<EvidenceGrids>& evidence,
                                          const std::vector<MultiPolygon2>& rooms,
                                          const FloorplanOptions& options);

}  // namespace enfilade
