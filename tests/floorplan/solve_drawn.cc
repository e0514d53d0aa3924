// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/floorplan/solve_drawn.h"

#include "tests/support/floorplan_checks.h"

namespace enfilade {

FloorplanReport SolveDrawn(const EvidenceGrids& grids, const FloorplanOptions& options,
                           int num_threads) {
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  RunContext context(num_threads);
  FloorplanReport report = SolveFloorplan({}, structure, {grids}, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

MultiPolygon2 RoomsOf(const Floorplan& plan) {
  MultiPolygon2 rooms;
  for (const Room& room : plan.storeys[0].rooms) rooms.push_back(room.polygon);
  return rooms;
}

}  // namespace enfilade
