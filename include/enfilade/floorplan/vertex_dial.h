// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// The numbers of corners, of all rooms with a curve together, for which there is a plan;
/// ascending. Empty when no room has a curve.
[[nodiscard]] std::vector<int> VertexNumbers(const Floorplan& plan);

/// The plan with so many corners in all rooms with a curve together, at the least cost: each of
/// these rooms gets one outline of its curve, with new walls; the others stay. Walls are numbered
/// anew, in the order of the rooms. Nothing when there is none (see VertexNumbers).
///
/// Requires curves with their edges' `seen` and `sigma_m`, and no openings in rooms with a curve.
/// Cost O(rooms × corners × lengths of the curves).
[[nodiscard]] std::optional<Floorplan> PlanWithVertices(const Floorplan& plan, int num_vertices);

/// One line for the user: why there is no such plan, and the nearest number for which there is one.
[[nodiscard]] std::string WhyNoSuchNumber(const Floorplan& plan, int num_vertices);

/// Gives a room of the storey one outline of its curve and appends its walls to the storey's.
void TakeOutline(const OutlineChoice& outline, double wall_thickness_m, Room& room, Storey& storey);

}  // namespace enfilade
