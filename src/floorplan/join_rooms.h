// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// The gaps, as thin as a wall, across which two rooms face each other end to end and where nobody
/// saw a wall from either side: two cores in one hall that did not quite meet. Only the first
/// num_entered rooms, in which cameras stand, are looked at. Gaps reach a little into both rooms.
[[nodiscard]] MultiPolygon2 FindUnseenWalls(const LoopField& field, double reach_m,
                                            size_t num_entered, const std::vector<Polygon2>& rooms);

/// Makes one room of those that a gap reaches into, and the gap; it takes the place of the first.
/// Rooms must not overlap, and do not afterwards. Returns how many joins were made.
int JoinAcross(const MultiPolygon2& gaps, std::vector<Polygon2>& rooms);

}  // namespace enfilade
