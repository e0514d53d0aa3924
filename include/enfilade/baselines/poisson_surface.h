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

/// The mesh's bounds are those of CGAL's own example.
struct PoissonOptions {
  double spacing_m = 0.1;
  double max_range_m = 15;
  double min_angle_deg = 20;
  double max_radius = 30;
  double max_distance = 0.375;
  double min_hole_m2 = 0.25;
  double min_room_m2 = 0.25;

  void Visit(OptionVisitor& v);
};

/// A rival without planes: the surface whose indicator function has the points' normals as
/// gradient, meshed by Delaunay refinement (CGAL). A face of the model is a triangle.
///
/// One thread is used, and nothing is random; but where CGAL's mesher has a choice it goes by
/// addresses, so single triangles may differ from run to run. Fewer than kMinSurfacePoints oriented
/// points, thinned, and points without a surface give kNoSurface and the reason. Requires one
/// profile a view. Throws StoppedError, before and after CGAL's work alone, and what
/// AccumulateEvidence throws. About 30 s and 0.9 GB for 60 000 points.
///
/// Kazhdan, Bolitho & Hoppe, "Poisson Surface Reconstruction" (SGP 2006).
[[nodiscard]] SurfaceReport ReconstructPoisson(const Scene& scene, const Structure& structure,
                                               const std::vector<ScenePoint>& points,
                                               const PoissonOptions& options, RunContext& context);

}  // namespace enfilade
