// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/volume_cut.h"

#include "src/baselines/oriented_points.h"

namespace enfilade {

void VolumeCutOptions::Visit(OptionVisitor& v) {
  v("voxel_m", voxel_m, "Side of a voxel.", {0.01, 1});
  v("smoothness_m", smoothness_m,
    "Price of the surface: the depth of clear evidence that weighs as much.", {0, 10});
  v("max_range_m", max_range_m, "Points farther from their camera say nothing.", {1, 100});
  v("max_megavoxels", max_megavoxels, "Refuse volumes of more million voxels.", {0.001, 400});
  v("min_hole_m2", min_hole_m2, "Smaller holes in a room of the plan are filled.", {0, 100});
  v("min_room_m2", min_room_m2, "Smaller rooms of the plan are dropped.", {0, 100});
}

SurfaceReport CutVolume(const Scene& scene, const Structure& structure,
                        const std::vector<ScenePoint>& points, const VolumeCutOptions& options,
                        RunContext& context) {
  context.CheckStop();
  SurfaceReport report;
  report.reason = ReasonForTooFew(SamplesOf(scene, structure, points, options.max_range_m));
  return report;
}

}  // namespace enfilade
