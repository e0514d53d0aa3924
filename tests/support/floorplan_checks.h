// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Fails the test unless the plan keeps what SolveFloorplan guarantees: rings simple and of the
/// right orientation, holes inside and apart, areas positive, rooms of a storey disjoint, ids
/// dense, walls equal to the rooms' edges with the room on their left, ceilings above floors,
/// openings on their walls.
void ExpectValidFloorplan(const Floorplan& plan);

}  // namespace enfilade
