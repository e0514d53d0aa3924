// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/ray_scene.h"

#include <limits>

namespace enfilade {

using Eigen::Vector3f;

namespace {

constexpr float kNear_m = 1e-4f;

std::vector<int> SurfacesOfTriangles(const std::vector<Surface>& surfaces) {
  std::vector<int> surface_of_triangle;
  for (size_t s = 0; s < surfaces.size(); ++s) {
    surface_of_triangle.insert(surface_of_triangle.end(), surfaces[s].triangles.size(),
                               static_cast<int>(s));
  }
  return surface_of_triangle;
}

TriangleTree MakeTree(const std::vector<Surface>& surfaces) {
  std::vector<Vector3f> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (const Surface& surface : surfaces) {
    const int first = static_cast<int>(vertices.size());
    for (const Eigen::Vector2f& uv : surface.vertices) {
      vertices.push_back(surface.Point(uv.x(), uv.y()));
    }
    for (const auto& [a, b, c] : surface.triangles) {
      triangles.push_back({first + a, first + b, first + c});
    }
  }
  return {vertices, triangles};
}

}  // namespace

RayScene::RayScene(const std::vector<Surface>& surfaces)
    : surfaces_(surfaces),
      surface_of_triangle_(SurfacesOfTriangles(surfaces)),
      tree_(MakeTree(surfaces)) {}

std::optional<RayHit> RayScene::Trace(const Vector3f& origin, const Vector3f& direction) const {
  const std::optional<TriangleHit> first =
      tree_.FirstHit(origin, direction, kNear_m, std::numeric_limits<float>::infinity());
  if (!first) return std::nullopt;
  RayHit hit;
  hit.surface_idx = surface_of_triangle_[static_cast<size_t>(first->triangle_idx)];
  hit.distance_m = first->distance;
  const Surface& surface = surfaces_[static_cast<size_t>(hit.surface_idx)];
  const Vector3f offset = origin + hit.distance_m * direction - surface.origin;
  hit.u = surface.axis_u.dot(offset);
  hit.v = surface.axis_v.dot(offset);
  return hit;
}

bool RayScene::IsBlocked(const Vector3f& from, const Vector3f& to) const {
  const Vector3f offset = to - from;
  const float distance_m = offset.norm();
  return tree_.IsHit(from, offset / distance_m, kNear_m, distance_m - kNear_m);
}

}  // namespace enfilade
