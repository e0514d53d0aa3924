// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/polygonal_surface.h"

#include "src/baselines/oriented_points.h"

namespace enfilade {

void PolygonalOptions::Visit(OptionVisitor& v) {
  v("spacing_m", spacing_m, "Points are thinned to one in a cube of this side.", {0.01, 1});
  v("max_range_m", max_range_m, "Points farther from their camera say nothing.", {1, 100});
  v("max_distance_m", max_distance_m, "Points of a plane lie within this distance of it.",
    {0.001, 1});
  v("max_angle_deg", max_angle_deg, "Normals of a plane lie within this angle of its own.",
    {1, 90});
  v("min_plane_m2", min_plane_m2, "Smaller planes are left out.", {0, 100});
  v("max_planes", max_planes, "Only so many planes are taken, the largest ones.", {4, 1000});
  v("fitting", fitting, "Weight of the points that lie on no face.", {0, 1});
  v("coverage", coverage, "Weight of the area of faces without points.", {0, 1});
  v("complexity", complexity, "Weight of edges between faces.", {0, 1});
  v("min_hole_m2", min_hole_m2, "Smaller holes in a room of the plan are filled.", {0, 100});
  v("min_room_m2", min_room_m2, "Smaller rooms of the plan are dropped.", {0, 100});
}

SurfaceReport ReconstructPolygonal(const Scene& scene, const Structure& structure,
                                   const std::vector<ScenePoint>& points,
                                   const PolygonalOptions& options, RunContext& context) {
  context.CheckStop();
  SurfaceReport report;
  report.reason = ReasonForTooFew(SamplesOf(scene, structure, points, options.max_range_m));
  return report;
}

}  // namespace enfilade
