// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"

namespace enfilade {

/// Raises the plan to a model: for every room, in the order of the storeys and rooms, its floor,
/// its ceiling and one quad for every edge of the outer ring and of the holes. Openings stay
/// closed. Normals point into the room; there are no textures yet.
///
/// Guarantees that every edge of a room's faces is shared by exactly two triangles, that both run
/// along it in opposite directions and that shared vertices are bit-identical.
/// Requires simple, disjoint rings and ceiling_z > floor_z; anything else is a bug of the caller.
/// Cost O(n log n) in the vertices, plus edges × walls for the walls' ids.
[[nodiscard]] BuildingModel ExtrudeFloorplan(const Floorplan& plan);

}  // namespace enfilade
