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

/// Poisson surface reconstruction.
[[nodiscard]] SurfaceReport ReconstructPoisson(const Scene& scene, const Structure& structure,
                                               const std::vector<ScenePoint>& points,
                                               const PoissonOptions& options, RunContext& context);

}  // namespace enfilade
