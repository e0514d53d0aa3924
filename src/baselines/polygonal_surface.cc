// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/polygonal_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mixed_integer_program_traits.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/property_map.h>
#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "enfilade/geometry/triangulate.h"
#include "src/baselines/binary_program.h"
#include "src/baselines/mesh_section.h"
#include "src/baselines/oriented_points.h"
#include "src/baselines/section_plan.h"
#include "src/baselines/surface_faces.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
// With the plane that it belongs to, −1 for none.
using PlanePoint = std::tuple<Kernel::Point_3, Kernel::Vector_3, int>;
using PointMap = CGAL::Nth_of_tuple_property_map<0, PlanePoint>;
using NormalMap = CGAL::Nth_of_tuple_property_map<1, PlanePoint>;
using PlaneMap = CGAL::Nth_of_tuple_property_map<2, PlanePoint>;
using PlanePoints = std::vector<PlanePoint>;
using NeighborQuery =
    CGAL::Shape_detection::Point_set::Sphere_neighbor_query<Kernel, PlanePoints, PointMap>;
using PlaneFit =
    CGAL::Shape_detection::Point_set::Least_squares_plane_fit_region<Kernel, PlanePoints, PointMap,
                                                                     NormalMap>;
using RegionGrowing = CGAL::Shape_detection::Region_growing<PlanePoints, NeighborQuery, PlaneFit>;
using Reconstruction = CGAL::Polygonal_surface_reconstruction<Kernel>;

// A closed body has at least so many faces.
constexpr size_t kMinPlanes = 4;
// Points of one plane are neighbours within this many sides of the cubes that they are thinned to,
// so that an empty cube does not part them.
constexpr double kNeighborRadius = 3;

// CGAL makes its solver itself, so what the solver is to look at it finds here.
struct SolverSetting {
  RunContext* context = nullptr;
  int max_nodes = 0;
  std::string reason;
};
thread_local SolverSetting solver_setting;

class Solver final : public CGAL::Mixed_integer_program_traits<double> {
 public:
  bool solve() override {
    BinaryProgram program;
    program.objective.assign(variables_.size(), 0);
    for (const auto& [variable, value] : objective_->coefficients())
      program.objective[static_cast<size_t>(variable->index())] = value;
    for (const Linear_constraint* constraint : constraints_) {
      BinaryProgram::Row row;
      for (const auto& [variable, value] : constraint->coefficients())
        row.coefficients.emplace_back(variable->index(), value);
      constraint->get_bounds(row.min, row.max);
      if (row.max >= Variable::infinity()) row.max = std::numeric_limits<double>::infinity();
      program.rows.push_back(std::move(row));
    }
    BinaryProgramReport report =
        SolveBinaryProgram(std::move(program), solver_setting.max_nodes, *solver_setting.context);
    solver_setting.reason = report.reason;
    result_.assign(report.x.begin(), report.x.end());
    return !report.x.empty();
  }
};

// The candidate faces come out with gaps where planes run along the axes, for CGAL cuts them with a
// box along these in rounded numbers; so it is given everything turned.
Eigen::Matrix3d TurnedFromHome() {
  return (Eigen::AngleAxisd(0.3, Vector3d::UnitX()) * Eigen::AngleAxisd(0.4, Vector3d::UnitY()) *
          Eigen::AngleAxisd(0.5, Vector3d::UnitZ()))
      .toRotationMatrix();
}

PlanePoints PointsOf(const std::vector<SurfaceSample>& samples) {
  PlanePoints points;
  const Eigen::Matrix3d turned_from_home = TurnedFromHome();
  for (const SurfaceSample& sample : samples) {
    const Vector3d p = turned_from_home * sample.position, n = turned_from_home * sample.normal;
    points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Vector_3(n.x(), n.y(), n.z()),
                        -1);
  }
  return points;
}

// Gives the points of the largest planes their number; how many planes there are in all.
size_t FindPlanes(const PolygonalOptions& options, PlanePoints& points) {
  const double points_in_m2 = 1 / (options.spacing_m * options.spacing_m);
  NeighborQuery neighbors(points, kNeighborRadius * options.spacing_m);
  PlaneFit fit(points, options.max_distance_m, options.max_angle_deg,
               std::max<size_t>(3, static_cast<size_t>(options.min_plane_m2 * points_in_m2)));
  std::vector<std::vector<size_t>> planes;
  RegionGrowing(points, neighbors, fit).detect(std::back_inserter(planes));
  std::stable_sort(planes.begin(), planes.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  const size_t num_taken = std::min(planes.size(), static_cast<size_t>(options.max_planes));
  for (size_t i = 0; i < num_taken; ++i) {
    for (const size_t point : planes[i]) std::get<2>(points[point]) = static_cast<int>(i);
  }
  return planes.size();
}

// Polygons over shared vertices that all turn the same way, counter-clockwise seen from outside.
struct PolygonSoup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<size_t>> polygons;
};

// CGAL's order hangs on addresses, so points and polygons are sorted.
PolygonSoup SoupOf(const Mesh& mesh) {
  PolygonSoup soup;
  std::map<Kernel::Point_3, size_t> index_of;
  for (const Mesh::Vertex_index vertex : mesh.vertices()) index_of.emplace(mesh.point(vertex), 0);
  for (auto& [point, index] : index_of) {
    index = soup.points.size();
    soup.points.push_back(point);
  }
  for (const Mesh::Face_index face : mesh.faces()) {
    std::vector<size_t>& polygon = soup.polygons.emplace_back();
    for (const Mesh::Vertex_index vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      polygon.push_back(index_of.at(mesh.point(vertex)));
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  }
  std::sort(soup.polygons.begin(), soup.polygons.end());
  CGAL::Polygon_mesh_processing::orient_polygon_soup(soup.points, soup.polygons);
  return soup;
}

// Rounded to 1 µm: the last digits of CGAL's fits hang on addresses.
Vector3d PositionOf(const Kernel::Point_3& p) {
  constexpr double kPerMetre = 1e6;
  const Vector3d position = TurnedFromHome().transpose() * Vector3d(p.x(), p.y(), p.z());
  return (kPerMetre * position).array().round() / kPerMetre;
}

// Twice the polygon's area along its normal.
Vector3d AreaVector(const std::vector<Vector3d>& polygon) {
  Vector3d area = Vector3d::Zero();
  for (size_t i = 0; i < polygon.size(); ++i)
    area += (polygon[i] - polygon[0]).cross(polygon[(i + 1) % polygon.size()] - polygon[0]);
  return area;
}

// A face for each polygon, seen from inside, and the same as triangles.
struct Surface {
  BuildingModel model;
  TriangleMesh mesh;
};

Surface SurfaceOf(const PolygonSoup& soup, const std::vector<StoreyStructure>& storeys) {
  Surface surface;
  double volume = 0;
  for (const Kernel::Point_3& point : soup.points)
    surface.mesh.vertices.push_back(PositionOf(point));
  for (const std::vector<size_t>& polygon : soup.polygons) {
    std::vector<Vector3d> corners;
    for (const size_t vertex : polygon) corners.push_back(surface.mesh.vertices[vertex]);
    volume += corners[0].dot(AreaVector(corners));
  }
  for (std::vector<size_t> polygon : soup.polygons) {
    if (volume > 0) std::reverse(polygon.begin(), polygon.end());
    ModelFace face;
    for (const size_t vertex : polygon) face.vertices.push_back(surface.mesh.vertices[vertex]);
    const Vector3d area = AreaVector(face.vertices);
    if (!(area.norm() > 0)) continue;
    Describe(area.normalized(), storeys, face);
    // Along the axis that the polygon is widest across.
    int axis = 0;
    area.cwiseAbs().maxCoeff(&axis);
    const bool is_turned = area[axis] < 0;
    Ring2 ring;
    for (const Vector3d& p : face.vertices) ring.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    if (is_turned) std::reverse(ring.begin(), ring.end());
    const int last = static_cast<int>(ring.size()) - 1;
    for (std::array<int, 3> triangle : Triangulate({ring, {}}).triangles) {
      if (is_turned) triangle = {last - triangle[2], last - triangle[1], last - triangle[0]};
      face.triangles.push_back(triangle);
      std::array<int, 3> of_mesh{};
      for (size_t k = 0; k < 3; ++k)
        of_mesh[k] = static_cast<int>(polygon[static_cast<size_t>(triangle[k])]);
      surface.mesh.triangles.push_back(of_mesh);
    }
    surface.model.faces.push_back(std::move(face));
  }
  return surface;
}

// Empty, with the reason, where there is no surface.
PolygonSoup Reconstruct(const std::vector<SurfaceSample>& samples, const PolygonalOptions& options,
                        RunContext& context, std::string& reason) {
  PlanePoints points = PointsOf(samples);
  const size_t num_planes = FindPlanes(options, points);
  context.CheckStop();
  if (num_planes < kMinPlanes) {
    reason =
        fmt::format("the points make {} planes, a closed surface takes {}", num_planes, kMinPlanes);
    return {};
  }
  if (num_planes > static_cast<size_t>(options.max_planes)) {
    context.log().Warning(fmt::format("polygonal surface: the {} largest of {} planes are taken",
                                      options.max_planes, num_planes));
  }
  solver_setting = {&context, options.max_nodes, {}};
  Reconstruction reconstruction(points, PointMap(), NormalMap(), PlaneMap());
  Mesh mesh;
  const bool is_found = reconstruction.reconstruct<Solver>(mesh, options.fitting, options.coverage,
                                                           options.complexity);
  const std::string solver_reason = std::exchange(solver_setting, {}).reason;
  if (!is_found) {
    reason = solver_reason.empty() ? reconstruction.error_message() : solver_reason;
    reason +=
        fmt::format(" ({} of {} planes)",
                    std::min(num_planes, static_cast<size_t>(options.max_planes)), num_planes);
    return {};
  }
  if (mesh.number_of_faces() == 0) reason = "the cheapest choice of faces is none";
  return SoupOf(mesh);
}

}  // namespace

void PolygonalOptions::Visit(OptionVisitor& v) {
  v("spacing_m", spacing_m, "Points are thinned to one in a cube of this side.", {0.01, 1});
  v("max_range_m", max_range_m, "Points farther from their camera say nothing.", {1, 100});
  v("max_distance_m", max_distance_m, "Points of a plane lie within this distance of it.",
    {0.001, 1});
  v("max_angle_deg", max_angle_deg, "Normals of a plane lie within this angle of its own.",
    {1, 90});
  v("min_plane_m2", min_plane_m2, "Smaller planes are left out.", {0, 100});
  v("max_planes", max_planes, "Only so many planes are taken, the largest ones.", {4, 1000});
  v("max_nodes", max_nodes, "The solver gives up beyond so many subproblems.", {1, 1e9});
  v("fitting", fitting, "Weight of the points that lie on no face.", {0, 1});
  v("coverage", coverage, "Weight of the area of faces without points.", {0, 1});
  v("complexity", complexity, "Weight of edges between faces.", {0, 1});
  v("min_hole_m2", min_hole_m2, "Smaller holes in a room of the plan are filled.", {0, 100});
  v("min_room_m2", min_room_m2, "Smaller rooms of the plan are dropped.", {0, 100});
}

SurfaceReport ReconstructPolygonal(const Scene& scene, const Structure& structure,
                                   const std::vector<ScenePoint>& points,
                                   const PolygonalOptions& options, RunContext& context) {
  SurfaceReport report;
  const std::vector<SurfaceSample> samples =
      Thinned(SamplesOf(scene, structure, points, options.max_range_m), options.spacing_m);
  report.reason = ReasonForTooFew(samples);
  if (!report.reason.empty()) return report;
  const PolygonSoup soup = Reconstruct(samples, options, context, report.reason);
  if (!report.reason.empty()) return report;
  Surface surface = SurfaceOf(soup, structure.storeys);
  report.model = std::move(surface.model);
  const auto section_at = [&](double z) {
    return LevelSection(surface.mesh, z, options.min_room_m2, options.min_hole_m2);
  };
  PlanFromSections(scene, structure, section_at, options.min_room_m2, context, report);
  return report;
}

}  // namespace enfilade
