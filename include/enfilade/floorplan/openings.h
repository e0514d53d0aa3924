// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// How doors, wide openings and windows are found in the pictures.
struct OpeningOptions {
  double step_m = 0.02;
  double min_door_log_odds = -0.25;
  double min_opening_strength = 1;
  double min_window_strength = 2.5;
  double max_wall_m = 0.45;

  void Visit(OptionVisitor& v);
};

struct FloorplanOptions;

/// What pictures show of walls.
class FacadeStore;

struct OpeningReport {
  int num_doors = 0;
  int num_openings = 0;  ///< wide ones without a door
  int num_windows = 0;
  int num_closets = 0;     ///< that nobody saw, behind doors that lead into no room
  double door_head_m = 0;  ///< of the home's doors, above the floor; 0 when none was seen
};

/// Finds the doors, wide openings and windows of a plan without any in the pictures and adds them
/// to its storeys.
///
/// Every wall is looked at by the views that stand in its room: their pictures are laid onto the
/// wall's plane and the mean of their edges taken, so that only what lies in the plane adds up. A
/// door, open or shut, shows two upright edges from the floor up to a level one, at the height of
/// the home's other doors. An opening is wider than 1.2 m, its head at any height, with a room on
/// either side. A window is a bright rectangle in a wall without a room behind. What is seen from
/// both sides of a wall is one.
///
/// A door leads somewhere: where one leads into no room and rooms go on past its wall beside it,
/// the space between them is added as a closet whose walls are inferred. Rooms and walls keep their
/// ids, those of closets follow.
///
/// The pictures' files are read (view.path), a few at a time, but not for walls whose facades
/// SolveFloorplan left in `facades` (FloorplanReport::facades); they are taken out of it.
/// Guarantees: openings lie on their wall, do not overlap on it, and have ids 0, 1, … in each
/// storey. Throws what reading pictures throws. Cost: O(area of the walls × views in their rooms).
OpeningReport FindOpenings(const Scene& scene, const FloorplanOptions& options, RunContext& context,
                           Floorplan& plan, FacadeStore* facades = nullptr);

}  // namespace enfilade
