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
/// these rooms gets one outline of its curve; the others stay. Where the dial stood before does not
/// matter. Nothing when there is none (see VertexNumbers).
///
/// Rooms that get the outline that they were drawn with keep their walls and openings, and if all
/// do, the plan is the one that was drawn. In the others walls are new: seen and σ from the curve,
/// thickness as drawn on the same line, σ of lengths and area as if walls erred independently.
/// Openings move to the nearest parallel wall of their room up to max_wall_m away where they find
/// room, else they are dropped. Rooms behind walls, and thickness between them, up to max_wall_m,
/// are measured anew if the plan as drawn tells them. Walls are numbered anew, in the order of the
/// rooms. Floorplan::dial tells the cost, with the bound of the problem's linear relaxation, and
/// drawn_storeys keeps the way back. Numbers are rounded as floorplan.json holds them, so a plan
/// from memory and one from the file give the same.
///
/// Requires curves with their edges' `seen` and `sigma_m`, and walls in rooms with a curve. Cost
/// O(rooms × corners × lengths of the curves).
[[nodiscard]] std::optional<Floorplan> PlanWithVertices(const Floorplan& plan, int num_vertices,
                                                        double max_wall_m);

/// One line for the user: why there is no such plan, and the nearest numbers for which there is
/// one.
[[nodiscard]] std::string WhyNoSuchNumber(const Floorplan& plan, int num_vertices);

/// One line for the user: what a plan of PlanWithVertices costs, and what it lost.
[[nodiscard]] std::string TellDial(const VertexDial& dial);

/// Gives a room of the storey one outline of its curve and appends its walls to the storey's.
void TakeOutline(const OutlineChoice& outline, double wall_thickness_m, Room& room, Storey& storey);

}  // namespace enfilade
