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

struct PolygonalOptions {
  double spacing_m = 0.1;
  double max_range_m = 15;
  double max_distance_m = 0.1;
  double max_angle_deg = 25;
  double min_plane_m2 = 0.5;
  int max_planes = 40;
  int max_nodes = 10000;
  double fitting = 0.43;
  double coverage = 0.27;
  double complexity = 0.3;
  double min_hole_m2 = 0.25;
  double min_room_m2 = 0.25;

  void Visit(OptionVisitor& v);
};

/// Polygonal surface reconstruction.
[[nodiscard]] SurfaceReport ReconstructPolygonal(const Scene& scene, const Structure& structure,
                                                 const std::vector<ScenePoint>& points,
                                                 const PolygonalOptions& options,
                                                 RunContext& context);

}  // namespace enfilade
