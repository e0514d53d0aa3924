// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// Solves one storey, 2.4 m high, without pictures, and expects the plan to be valid.
[[nodiscard]] FloorplanReport SolveDrawn(const EvidenceGrids& grids,
                                         const FloorplanOptions& options = {}, int num_threads = 2);

/// The rooms of the first storey.
[[nodiscard]] MultiPolygon2 RoomsOf(const Floorplan& plan);

}  // namespace enfilade
