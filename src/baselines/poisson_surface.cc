// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/poisson_surface.h"

#include "src/baselines/oriented_points.h"

namespace enfilade {

void PoissonOptions::Visit(OptionVisitor& v) {
  v("spacing_m", spacing_m, "Points are thinned to one in a cube of this side.", {0.01, 1});
  v("max_range_m", max_range_m, "Points farther from their camera say nothing.", {1, 100});
  v("min_angle_deg", min_angle_deg, "Smallest angle of a triangle.", {1, 30});
  v("max_radius", max_radius, "Largest circle round a triangle, in mean distances of points.",
    {0.1, 1000});
  v("max_distance", max_distance, "Largest distance of a triangle from the surface, likewise.",
    {0.01, 100});
  v("min_hole_m2", min_hole_m2, "Smaller holes in a room of the plan are filled.", {0, 100});
  v("min_room_m2", min_room_m2, "Smaller rooms of the plan are dropped.", {0, 100});
}

SurfaceReport ReconstructPoisson(const Scene& scene, const Structure& structure,
                                 const std::vector<ScenePoint>& points,
                                 const PoissonOptions& options, RunContext& context) {
  context.CheckStop();
  SurfaceReport report;
  report.reason = ReasonForTooFew(SamplesOf(scene, structure, points, options.max_range_m));
  return report;
}

}  // namespace enfilade
