// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"

namespace enfilade {

/// How core free space is cut out of the grids.
struct CoreOptions {
  double min_free_log_odds = 1;
  double max_wall_log_odds = 1;
  int min_free_rays = 3;
  int min_wall_points = 5;
  double opening_radius_m = 0.15;
  double min_neck_m = 0.5;
  double max_hole_m2 = 0.5;
  double erosion_m = 0.05;
  double camera_snap_m = 0.25;

  void Visit(OptionVisitor& v);
};

struct CoreReport {
  CoreImage core;
  int num_cores = 0;
  std::vector<int> views_without_core;  ///< cameras farther than camera_snap_m from every core
  int num_necks_cut = 0;
  double dropped_m2 = 0;  ///< free space that no camera stands in, or only behind a cut neck
  double far_m2 = 0;  ///< free space that one panorama alone sees from afar and that was taken in
};

/// The free space that is inside the home beyond doubt, one component for each region that
/// panoramas stand in; floorplan loops must go round it.
///
/// Free cells that are near a camera or seen free from two directions (EvidenceGrids::support) and
/// carry no wall; opened; cut at necks narrower than min_neck_m unless panoramas stand on both
/// sides or in the neck, or two panoramas see each other through it; only components with a camera;
/// of log-odds, parts beside them that one panorama sees from afar, where less of their border is
/// open than is seen as wall or leads to the core; small holes without wall evidence filled; eroded
/// so that a path has room.
///
/// Guarantees: components are 4-connected, separated by at least one cell, clear of the grid's
/// border, numbered by the smallest view_idx that stands in them; at most 65535 of them. Every
/// camera is in a core or listed. Cost O(cells + cameras² · side).
[[nodiscard]] CoreReport FindCore(const EvidenceGrids& grids, const CoreOptions& options,
                                  RunContext& context);

}  // namespace enfilade
