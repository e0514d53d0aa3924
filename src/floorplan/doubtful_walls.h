// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// Moves walls whose line is likely furniture's outwards onto the line of one whose line is not.
///
/// A wall may move where a sure wall of its own room, or of one beside it, runs on a line behind
/// it, with the room on the same side, no farther than furniture is deep; where the evidence knows
/// of free space between the two; and where no other room lies there. It is taken to go on along
/// the nearest such line. `sigmas` (FindWallSigmas) has one entry a wall.
///
/// Changes the polygons, which are those of the storey's rooms in their order, and returns the
/// number of walls moved. Rooms stay simple and disjoint.
int MoveDoubtfulWalls(const LoopField& field, const FloorplanOptions& options, const Storey& storey,
                      std::span<const WallSigma> sigmas, std::vector<Polygon2>& polygons);

}  // namespace enfilade
