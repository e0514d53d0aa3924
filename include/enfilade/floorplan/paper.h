// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/evidence/types.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/image/image.h"

namespace enfilade {

/// Options of the method as it was published: Cabral & Furukawa, "Piecewise Planar and Compact
/// Floorplan Reconstruction from Images" (CVPR 2014). See docs/algorithms/paper_floorplan.md.
struct PaperOptions {
  double alpha_m = 0.125;  ///< five cells of 2.5 cm
  double wall_points_per_m = 40;
  double hidden_space_m2 = 1;
  bool use_anchors = true;
  double anchor_points_per_m = 40;
  double anchor_support_m = 0.3;
  double anchor_spacing_m = 0.5;
  double anchor_reach_m = 0.3;
  int max_leg_edges = 16;
  int max_vertices = 160;

  void Visit(OptionVisitor& v);
};

/// A place that the second path has to pass, on a wall face.
struct PaperAnchor {
  Eigen::Vector2d position{0, 0};
  Eigen::Vector2d direction{1, 0};  ///< along the wall, the room on its left
  double points = 0;                ///< wall evidence: points a cell, smoothed along the wall
};

/// How one outline came about, all in the home frame.
struct PaperLoop {
  std::array<Eigen::Vector2d, 2> cut;  ///< from the core to the first path: its start and end line
  Ring2 contour;                       ///< of the closed free space, which orders the anchors
  Ring2 first_path;
  double first_cost_m = 0;           ///< with corners
  std::vector<PaperAnchor> anchors;  ///< in the order of the second path
  int num_anchors_refused = 0;       ///< which the rest of the evidence contradicts
  Ring2 second_path;                 ///< the first one where no anchors could be passed
};

/// What the method did on one storey, for a picture of it.
struct PaperStorey {
  CoreImage core;  ///< as EvidenceGrids::core, with bridges between cores and hidden spaces
  std::vector<PaperLoop> loops;
};

}  // namespace enfilade
