// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/baselines/surface_report.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// Weights as in the paper. A home has some forty planes, but the number of unknowns grows with
/// their cube: what GLPK finishes in seconds is about 14.
struct PolygonalOptions {
  double spacing_m = 0.1;
  double max_range_m = 15;
  double max_distance_m = 0.1;
  double max_angle_deg = 25;
  double min_plane_m2 = 0.5;
  int max_planes = 14;
  int max_nodes = 10000;
  double fitting = 0.43;
  double coverage = 0.27;
  double complexity = 0.3;
  double min_hole_m2 = 0.25;
  double min_room_m2 = 0.25;

  void Visit(OptionVisitor& v);
};

/// A rival made of planes: region growing finds them in the points, each is cut by all others, and
/// of the pieces those are chosen that make a closed surface, lie on points and have few edges,
/// exactly (CGAL, GLPK).
///
/// With more planes than max_planes the largest are taken, with a warning. Fewer than
/// kMinSurfacePoints oriented points, thinned, fewer than four planes, a choice of no face, and
/// more than max_nodes subproblems give kNoSurface and the reason. Requires one profile a view.
/// Throws StoppedError and what AccumulateEvidence throws. Cost exponential in the number of planes
/// at worst, so the caller should limit its time.
///
/// Nan & Wonka, "PolyFit: Polygonal Surface Reconstruction from Point Clouds" (ICCV 2017).
[[nodiscard]] SurfaceReport ReconstructPolygonal(const Scene& scene, const Structure& structure,
                                                 const std::vector<ScenePoint>& points,
                                                 const PolygonalOptions& options,
                                                 RunContext& context);

}  // namespace enfilade
