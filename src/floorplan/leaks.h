// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

struct LeakReport {
  int num_leaks = 0;      ///< necks beyond which nothing belongs to the home
  double leaks_m2 = 0;    ///< what was left out there
  int num_mirrors = 0;    ///< of the leaks, those that repeat the room reflected
  int num_set_apart = 0;  ///< rooms seen only through their door
};

/// Looks beyond the necks of each room up to max_neck_m long where no camera stands. What is seen
/// there through a window or a glass door, or in a mirror, is left out; what has walls like a room
/// stays, and becomes a room of its own behind the others if the neck is as narrow as a door.
///
/// The plans with and without are compared in metres of wall. With: the loop's cost of the walls
/// beyond the neck (unseen wall, free space outside, solid wall inside, corners). Without: the seen
/// walls beyond that the plan then lacks, and the neck as a wall, which pays for no free space
/// behind it. What the home closes round, as unseen space (TakeInUnseenSpace), is no leak. Walls
/// that repeat the room reflected across the neck count as unseen. Rooms must not overlap, and do
/// not afterwards. Without cameras nothing is done.
LeakReport LeaveLeaks(const LoopField& field, const FloorplanOptions& options,
                      const std::vector<EvidenceCamera>& cameras, RunContext& context,
                      std::vector<Polygon2>& rooms);

}  // namespace enfilade
