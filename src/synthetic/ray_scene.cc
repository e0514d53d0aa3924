// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/ray_scene.h"

#include <algorithm>
#include <array>
#include <limits>

#include "enfilade/base/check.h"

namespace enfilade {

using Eigen::Vector3f;

namespace {

constexpr float kNear_m = 1e-4f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr size_t kBatch = 64;

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

RayHit RayScene::MakeHit(const TriangleHit& first, const Vector3f& origin,
                         const Vector3f& direction) const {
  RayHit hit;
  hit.surface_idx = surface_of_triangle_[static_cast<size_t>(first.triangle_idx)];
  hit.distance_m = first.distance;
  const Surface& surface = surfaces_[static_cast<size_t>(hit.surface_idx)];
  const Vector3f offset = origin + hit.distance_m * direction - surface.origin;
  hit.u = surface.axis_u.dot(offset);
  hit.v = surface.axis_v.dot(offset);
  return hit;
}

std::optional<RayHit> RayScene::Trace(const Vector3f& origin, const Vector3f& direction) const {
  const std::optional<TriangleHit> first = tree_.FirstHit(origin, direction, kNear_m, kInfinity);
  if (!first) return std::nullopt;
  return MakeHit(*first, origin, direction);
}

void RayScene::TraceFrom(const Vector3f& origin, std::span<const Vector3f> directions,
                         std::span<std::optional<RayHit>> hits) const {
  ENFILADE_CHECK(directions.size() == hits.size());
  std::array<std::optional<TriangleHit>, kBatch> first;
  for (size_t i = 0; i < directions.size(); i += kBatch) {
    const auto batch = directions.subspan(i, std::min(kBatch, directions.size() - i));
    tree_.FirstHits(origin, batch, kNear_m, kInfinity, std::span(first).first(batch.size()));
    for (size_t k = 0; k < batch.size(); ++k) {
      hits[i + k] = first[k] ? std::optional(MakeHit(*first[k], origin, batch[k])) : std::nullopt;
    }
  }
}

bool RayScene::IsBlocked(const Vector3f& from, const Vector3f& to) const {
  const Vector3f offset = to - from;
  const float distance_m = offset.norm();
  return tree_.IsHit(from, offset / distance_m, kNear_m, distance_m - kNear_m);
}

void RayScene::FindBlocked(const Vector3f& from, std::span<const Vector3f> to,
                           std::span<bool> is_blocked) const {
  ENFILADE_CHECK(to.size() == is_blocked.size());
  std::array<Vector3f, kBatch> directions;
  std::array<float, kBatch> far_m{};
  for (size_t i = 0; i < to.size(); i += kBatch) {
    const size_t count = std::min(kBatch, to.size() - i);
    for (size_t k = 0; k < count; ++k) {
      const Vector3f offset = to[i + k] - from;
      const float distance_m = offset.norm();
      directions[k] = offset / distance_m;
      far_m[k] = distance_m - kNear_m;
    }
    tree_.AreHit(from, std::span(directions).first(count), kNear_m, std::span(far_m).first(count),
                 is_blocked.subspan(i, count));
  }
}

}  // namespace enfilade
