// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Gives every room of the plan, which SolveFloorplan drew from this evidence in log-odds, its
/// curve: for every number of corners up to its own the cheapest outline whose walls lie on the
/// lines of its walls (docs/algorithms/vertex_dial.md); the last is the room as drawn. An outline
/// is in the curve if none with fewer corners costs as little.
///
/// Cost of an outline, in metres of unseen wall: what it changes. New wall costs its length where
/// no face is seen, free space that it cuts off outside_weight a square metre, solid wall that it
/// takes in inside_weight. Cameras stay inside. Guarantees: whatever outlines are taken together,
/// rooms do not overlap, and an outline stays nearer to its room than to any other, by a wall's
/// thickness. `seen` and `sigma_m` are those of the walls on whose lines they lie, `seen` measured
/// anew where a wall has another length. To be called once σ are known. Costs and corners are
/// rounded to what floorplan.json holds.
///
/// `evidence` has one entry a storey. Cost: O(area + n³) for a room of n walls, little in practice.
void FindRoomCurves(const std::vector<EvidenceGrids>& evidence, const FloorplanOptions& options,
                    RunContext& context, Floorplan& plan);

}  // namespace enfilade
