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

struct VolumeCutOptions {
  double voxel_m = 0.05;
  double smoothness_m = 0.05;
  double max_range_m = 15;
  double max_megavoxels = 50;
  double min_hole_m2 = 0.25;
  double min_room_m2 = 0.25;

  void Visit(OptionVisitor& v);
};

/// The volumetric graph cut that the paper compares itself with.
[[nodiscard]] SurfaceReport CutVolume(const Scene& scene, const Structure& structure,
                                      const std::vector<ScenePoint>& points,
                                      const VolumeCutOptions& options, RunContext& context);

}  // namespace enfilade
