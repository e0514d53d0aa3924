// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "enfilade/base/errors.h"
#include "enfilade/base/hash.h"
#include "enfilade/geometry/boolean.h"
#include "enfilade/image/image.h"
#include "src/exchange/obj_mesh.h"
#include "src/exchange/picture_files.h"
#include "src/exchange/pose_file.h"
#include "src/exchange/truth_sources.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMaxExtent_m = 1000;
constexpr double kSameVertex_m = 1e-3;
constexpr int kMaxCellsASide = 1024;
constexpr double kMinCell_m = 0.025;
constexpr double kLevel_m = 0.05;
constexpr double kLevelShare = 0.9;

using Triangle = std::array<Vector3d, 3>;

std::vector<Triangle> TrianglesOf(const ObjMesh& mesh) {
  std::vector<Triangle> triangles;
  for (const ObjTriangle& triangle : mesh.triangles) {
    const auto corner = [&](size_t k) {
      return mesh.vertices[static_cast<size_t>(triangle.corners.at(k))];
    };
    triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return triangles;
}

MultiPolygon2 ProjectToPlan(const std::vector<Triangle>& triangles) {
  MultiPolygon2 parts;
  for (const Triangle& triangle : triangles) {
    Ring2 ring{triangle[0].head<2>(), triangle[1].head<2>(), triangle[2].head<2>()};
    const double area = SignedArea(ring);
    if (std::abs(area) < 1e-9) continue;
    if (area < 0) std::swap(ring[1], ring[2]);
    parts.push_back({std::move(ring), {}});
  }
  MultiPolygon2 region = Union(parts);
  for (Polygon2& polygon : region) {
    polygon.outer = RemoveCollinear(polygon.outer, kSameVertex_m);
    for (Ring2& hole : polygon.holes) hole = RemoveCollinear(hole, kSameVertex_m);
    std::erase_if(polygon.holes, [](const Ring2& hole) { return hole.size() < 3; });
  }
  std::erase_if(region, [](const Polygon2& polygon) { return polygon.outer.size() < 3; });
  return region;
}

Eigen::AlignedBox2d PlanBounds(const std::vector<Triangle>& triangles) {
  Eigen::AlignedBox2d bounds;
  for (const Triangle& triangle : triangles) {
    for (const Vector3d& corner : triangle) bounds.extend(Vector2d(corner.head<2>()));
  }
  return bounds;
}

// Lowest and highest surface over each cell of a grid on the plan; infinite where there is none.
struct HeightMaps {
  Eigen::AlignedBox2d bounds;
  double cell_m = 0;
  Image<double> low, high;

  explicit HeightMaps(const std::vector<Triangle>& triangles) : bounds(PlanBounds(triangles)) {
    cell_m = std::max(kMinCell_m, bounds.sizes().maxCoeff() / kMaxCellsASide);
    const int rows = Cell(bounds.max().y(), bounds.min().y()) + 1;
    const int cols = Cell(bounds.max().x(), bounds.min().x()) + 1;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    low = Image<double>(rows, cols, 1, kInfinity);
    high = Image<double>(rows, cols, 1, -kInfinity);
    for (const Triangle& triangle : triangles) Draw(triangle);
  }

  [[nodiscard]] int Cell(double x, double origin) const {
    return static_cast<int>(std::floor((x - origin) / cell_m));
  }

  void Draw(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const double area = (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (std::abs(area) < 1e-9) return;
    Eigen::AlignedBox2d box;
    for (const Vector3d& corner : triangle) box.extend(Vector2d(corner.head<2>()));
    for (int row = Cell(box.min().y(), bounds.min().y());
         row <= Cell(box.max().y(), bounds.min().y()); ++row) {
      for (int col = Cell(box.min().x(), bounds.min().x());
           col <= Cell(box.max().x(), bounds.min().x()); ++col) {
        const Vector2d p = bounds.min() + cell_m * Vector2d(col + 0.5, row + 0.5) - a.head<2>();
        const double u = (p.x() * (c - a).y() - p.y() * (c - a).x()) / area;
        const double v = ((b - a).x() * p.y() - (b - a).y() * p.x()) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const double z = a.z() + u * (b - a).z() + v * (c - a).z();
        low(row, col) = std::min(low(row, col), z);
        high(row, col) = std::max(high(row, col), z);
      }
    }
  }
};

// The height that most of a surface has, none when less than 90 % lies within 5 cm of it.
std::optional<double> LevelHeight(const Image<double>& heights) {
  std::vector<double> finite;
  std::copy_if(heights.data().begin(), heights.data().end(), std::back_inserter(finite),
               [](double z) { return std::isfinite(z); });
  if (finite.empty()) return std::nullopt;
  std::sort(finite.begin(), finite.end());
  const double median = finite[finite.size() / 2];
  const auto begin = std::lower_bound(finite.begin(), finite.end(), median - kLevel_m);
  const auto end = std::upper_bound(finite.begin(), finite.end(), median + kLevel_m);
  const double share = static_cast<double>(end - begin) / static_cast<double>(finite.size());
  return share >= kLevelShare ? std::optional(median) : std::nullopt;
}

// The outline of the part that the camera stands in, else of the first.
const Polygon2& PartAround(const MultiPolygon2& region, const Vector2d& camera) {
  const auto it = std::find_if(region.begin(), region.end(),
                               [&](const Polygon2& part) { return Contains(part, camera); });
  return it == region.end() ? region.front() : *it;
}

std::vector<TruthView> ReadViews(const std::filesystem::path& folder, const TruthRoom& room) {
  std::vector<TruthView> views;
  const std::optional<PoseLocation> location = FindPoses(folder);
  if (!location) return views;
  const PictureFiles files(folder);
  const PoseFile poses = ReadPoseFile(*location, 0);
  for (const PosedPicture& posed : poses.pictures) {
    TruthView view;
    view.picture = std::filesystem::path(posed.name).filename().native();
    const std::filesystem::path path = files.Find(posed.name, poses.base);
    if (!path.empty()) view.sha256 = Sha256OfFile(path);
    view.world_from_cam = posed.world_from_cam;
    const Vector3d& position = posed.world_from_cam.translation;
    const Polygon2& part = PartAround(room.region, position.head<2>());
    view.is_inside = Contains(part, position.head<2>());
    view.visible_layout = part.outer;
    if (room.floor_z) view.camera_height_m = position.z() - *room.floor_z;
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace

GroundTruth ReadObjTruth(const std::filesystem::path& path) {
  const std::vector<Triangle> triangles = TrianglesOf(ReadObjMesh(path));
  TruthRoom room;
  room.region = ProjectToPlan(triangles);
  if (room.region.empty() || PlanBounds(triangles).sizes().maxCoeff() > kMaxExtent_m) {
    throw InvalidInputError(path.native(),
                            "is no mesh of a room: its plan is empty or over 1 km wide",
                            "give a mesh in metres, z up");
  }
  const HeightMaps heights(triangles);
  room.floor_z = LevelHeight(heights.low);
  room.ceiling_z = LevelHeight(heights.high);
  GroundTruth truth;
  truth.walls = CutGaps(room.region, {}, 0);
  truth.views = ReadViews(path.parent_path(), room);
  truth.rooms.push_back(std::move(room));
  return truth;
}

}  // namespace enfilade
