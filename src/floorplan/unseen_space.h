// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// What lies between rooms less than unseen_gap_m apart, or in a hole among them, is no open air:
/// the rest of a room that was cut off, cupboards whose fronts were taken for walls, closets.
/// Space behind a boundary that nobody saw as a wall goes to that room, other shallow space to the
/// room beside it whose outline it simplifies most, and deep space becomes a room of its own,
/// appended to `rooms`. A wall's thickness stays free before every other room, and space as thin as
/// a wall stays wall. Rooms must not overlap, and do not afterwards. Returns the area, m².
double TakeInUnseenSpace(const LoopField& field, const FloorplanOptions& options,
                         std::vector<Polygon2>& rooms);

}  // namespace enfilade
