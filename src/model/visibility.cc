// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/model/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Two faces of one wall lie no farther apart than this.
constexpr double kMaxWall_m = 0.6;
// A ray ends this much before its point, so that the point's own face does not count.
constexpr double kEndGap_m = 0.01;
constexpr double kStep_m = 1e-3;
constexpr int kMaxPassed = 16;

bool IsThrough(const Opening& opening, const ModelFace& face) {
  if (opening.kind == OpeningKind::kWindow || face.kind != SurfaceKind::kWall) return false;
  if (face.room_id != opening.room_id && face.room_id != opening.other_room_id) return false;
  const Vector2d along = opening.b - opening.a;
  const Vector2d normal = face.normal.head<2>();
  if (along.norm() == 0 || std::abs(normal.dot(along)) > 0.2 * along.norm()) return false;
  return std::abs(normal.dot(opening.a - face.vertices[0].head<2>())) <= kMaxWall_m;
}

std::vector<int> FacesOfTriangles(const BuildingModel& model) {
  std::vector<int> face_of_triangle;
  for (size_t f = 0; f < model.faces.size(); ++f) {
    face_of_triangle.insert(face_of_triangle.end(), model.faces[f].triangles.size(),
                            static_cast<int>(f));
  }
  return face_of_triangle;
}

TriangleTree MakeTree(const BuildingModel& model) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (const ModelFace& face : model.faces) {
    const int first = static_cast<int>(vertices.size());
    for (const Vector3d& p : face.vertices) vertices.emplace_back(p.cast<float>());
    for (const auto& [a, b, c] : face.triangles) {
      triangles.push_back({first + a, first + b, first + c});
    }
  }
  return {vertices, triangles};
}

}  // namespace

bool Visibility::Pierced::Holds(const Vector3d& p) const {
  const double t = along.dot(p.head<2>() - origin);
  return t >= 0 && t <= length_m && (head_z <= sill_z || (p.z() >= sill_z && p.z() <= head_z));
}

std::vector<Visibility::Pierced> Visibility::PiercedBy(const Storey& storey,
                                                       const ModelFace& face) {
  std::vector<Pierced> pierced;
  for (const Opening& opening : storey.openings) {
    if (!IsThrough(opening, face)) continue;
    const Vector2d along = opening.b - opening.a;
    pierced.push_back({opening.a, along.normalized(), along.norm(), opening.sill_z, opening.head_z,
                       opening.kind == OpeningKind::kDoor});
  }
  return pierced;
}

Visibility::Visibility(const BuildingModel& model, const Floorplan& plan)
    : face_of_triangle_(FacesOfTriangles(model)), tree_(MakeTree(model)) {
  for (const ModelFace& face : model.faces) {
    const auto storey_idx = static_cast<size_t>(face.storey_idx);
    faces_.push_back({face.normal, storey_idx < plan.storeys.size()
                                       ? PiercedBy(plan.storeys[storey_idx], face)
                                       : std::vector<Pierced>()});
  }
}

Visibility::Walk Visibility::WalkAlong(const Vector3d& camera, const Vector3d& direction,
                                       double end_m) const {
  Walk walk;
  double begin = 0, free_until = 0;
  for (int i = 0; i < kMaxPassed; ++i) {
    const std::optional<TriangleHit> hit =
        tree_.FirstHit(camera.cast<float>(), direction.cast<float>(), static_cast<float>(begin),
                       static_cast<float>(end_m));
    if (!hit) {
      walk.is_free = true;
      return walk;
    }
    const double distance_m = hit->distance;
    const int face_idx = face_of_triangle_[static_cast<size_t>(hit->triangle_idx)];
    const Face& face = faces_[static_cast<size_t>(face_idx)];
    if (face.normal.dot(direction) < 0) {
      const Vector3d p = camera + distance_m * direction;
      const auto opening = std::find_if(face.pierced.begin(), face.pierced.end(),
                                        [&](const Pierced& pierced) { return pierced.Holds(p); });
      if (opening == face.pierced.end()) {
        walk.sight.face = {face_idx, distance_m};
        return walk;
      }
      if (opening->is_door && !walk.sight.door) walk.sight.door = {face_idx, distance_m};
      free_until = distance_m;
    } else if (distance_m - free_until > kMaxWall_m) {
      return walk;
    }
    begin = distance_m + kStep_m;
  }
  return walk;
}

bool Visibility::IsSeen(const Vector3d& camera, const Vector3d& point) const {
  const double distance = (point - camera).norm();
  const double end = distance - std::max(kEndGap_m, 0.002 * distance);
  if (end <= 0) return true;
  return WalkAlong(camera, (point - camera) / distance, end).is_free;
}

ModelSight Visibility::Look(const Vector3d& camera, const Vector3d& direction) const {
  return WalkAlong(camera, direction, std::numeric_limits<float>::infinity()).sight;
}

}  // namespace enfilade
