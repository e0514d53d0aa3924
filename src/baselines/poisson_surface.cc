// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/poisson_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "src/baselines/mesh_section.h"
#include "src/baselines/oriented_points.h"
#include "src/baselines/section_plan.h"
#include "src/baselines/surface_faces.h"

namespace enfilade {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using PointWithNormal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using PointMap = CGAL::First_of_pair_property_map<PointWithNormal>;
using NormalMap = CGAL::Second_of_pair_property_map<PointWithNormal>;

constexpr unsigned kNumNeighbors = 6;  // that the mean distance of points is taken over

// CGAL wants the normals to look out of the body, which is the air of the home.
std::vector<PointWithNormal> PointsOf(const std::vector<SurfaceSample>& samples) {
  std::vector<PointWithNormal> points;
  for (const SurfaceSample& sample : samples) {
    const Eigen::Vector3d &p = sample.position, &n = sample.normal;
    points.push_back({{p.x(), p.y(), p.z()}, {-n.x(), -n.y(), -n.z()}});
  }
  return points;
}

// Turns the triangles to the inside. CGAL's order hangs on addresses, so both lists are sorted.
TriangleMesh TurnedMesh(const Mesh& mesh) {
  std::map<Kernel::Point_3, int> index_of;
  for (const Mesh::Vertex_index vertex : mesh.vertices()) index_of.emplace(mesh.point(vertex), 0);
  TriangleMesh turned;
  for (auto& [p, index] : index_of) {
    index = static_cast<int>(turned.vertices.size());
    turned.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Mesh::Face_index face : mesh.faces()) {
    std::array<int, 3> triangle{};
    size_t k = 3;
    for (const Mesh::Vertex_index vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      triangle[--k] = index_of.at(mesh.point(vertex));
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    turned.triangles.push_back(triangle);
  }
  std::sort(turned.triangles.begin(), turned.triangles.end());
  return turned;
}

// Empty, with the reason, where there is no surface.
TriangleMesh Reconstruct(const std::vector<SurfaceSample>& samples, const PoissonOptions& options,
                         std::string& reason) {
  CGAL::get_default_random() = CGAL::Random(0);  // else the mesher begins differently every time
  const std::vector<PointWithNormal> points = PointsOf(samples);
  Mesh mesh;
  try {
    const double spacing_m = CGAL::compute_average_spacing<CGAL::Sequential_tag>(
        points, kNumNeighbors, CGAL::parameters::point_map(PointMap()));
    if (!CGAL::poisson_surface_reconstruction_delaunay(
            points.begin(), points.end(), PointMap(), NormalMap(), mesh, spacing_m,
            options.min_angle_deg, options.max_radius, options.max_distance)) {
      reason = "the Poisson function has no surface";
      return {};
    }
  } catch (const CGAL::Failure_exception& failure) {
    reason = std::string("CGAL finds no surface: ") + failure.expression();
    return {};
  }
  return TurnedMesh(mesh);
}

}  // namespace

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
  SurfaceReport report;
  const std::vector<SurfaceSample> samples =
      Thinned(SamplesOf(scene, structure, points, options.max_range_m), options.spacing_m);
  report.reason = ReasonForTooFew(samples);
  if (!report.reason.empty()) return report;
  context.CheckStop();
  const TriangleMesh mesh = Reconstruct(samples, options, report.reason);
  if (!report.reason.empty()) return report;
  context.CheckStop();
  report.model = ModelOf(mesh, structure.storeys);
  const auto section_at = [&](double z) {
    return LevelSection(mesh, z, options.min_room_m2, options.min_hole_m2);
  };
  PlanFromSections(scene, structure, section_at, options.min_room_m2, context, report);
  return report;
}

}  // namespace enfilade
