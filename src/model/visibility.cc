// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/visibility.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "enfilade/base/errors.h"

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

// An opening as it pierces one face: a rectangle on the face's plane.
struct Pierced {
  Vector2d origin, along;
  double length_m = 0;
  double sill_z = 0, head_z = 0;

  [[nodiscard]] bool Holds(const Vector3d& p) const {
    const double t = along.dot(p.head<2>() - origin);
    return t >= 0 && t <= length_m && (head_z <= sill_z || (p.z() >= sill_z && p.z() <= head_z));
  }
};

bool IsThrough(const Opening& opening, const ModelFace& face) {
  if (opening.kind == OpeningKind::kWindow || face.kind != SurfaceKind::kWall) return false;
  if (face.room_id != opening.room_id && face.room_id != opening.other_room_id) return false;
  const Vector2d along = opening.b - opening.a;
  const Vector2d normal = face.normal.head<2>();
  if (along.norm() == 0 || std::abs(normal.dot(along)) > 0.2 * along.norm()) return false;
  return std::abs(normal.dot(opening.a - face.vertices[0].head<2>())) <= kMaxWall_m;
}

std::vector<Pierced> PiercedBy(const Storey& storey, const ModelFace& face) {
  std::vector<Pierced> pierced;
  for (const Opening& opening : storey.openings) {
    if (!IsThrough(opening, face)) continue;
    const Vector2d along = opening.b - opening.a;
    pierced.push_back(
        {opening.a, along.normalized(), along.norm(), opening.sill_z, opening.head_z});
  }
  return pierced;
}

}  // namespace

struct Visibility::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<int> face_of_triangle;
  std::vector<Vector3d> normal_of_face;
  std::vector<std::vector<Pierced>> pierced_of_face;

  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void AddTriangles(const BuildingModel& model) {
    size_t num_vertices = 0, num_triangles = 0;
    for (const ModelFace& face : model.faces) {
      num_vertices += face.vertices.size();
      num_triangles += face.triangles.size();
    }
    if (num_triangles == 0) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), num_vertices));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), num_triangles));
    unsigned first = 0;
    for (size_t f = 0; f < model.faces.size(); ++f) {
      for (const Vector3d& p : model.faces[f].vertices) {
        for (int i = 0; i < 3; ++i) *vertices++ = static_cast<float>(p[i]);
      }
      for (const std::array<int, 3>& triangle : model.faces[f].triangles) {
        for (const int corner : triangle) *indices++ = first + static_cast<unsigned>(corner);
        face_of_triangle.push_back(static_cast<int>(f));
      }
      first += static_cast<unsigned>(model.faces[f].vertices.size());
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
};

Visibility::Visibility(const BuildingModel& model, const Floorplan& plan)
    : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice("threads=1");
  if (impl_->device == nullptr) {
    throw DependencyError("Embree", "cannot be started",
                          "check that libembree3 fits this processor");
  }
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  impl_->AddTriangles(model);
  rtcCommitScene(impl_->scene);
  for (const ModelFace& face : model.faces) {
    impl_->normal_of_face.push_back(face.normal);
    const auto storey_idx = static_cast<size_t>(face.storey_idx);
    impl_->pierced_of_face.push_back(storey_idx < plan.storeys.size()
                                         ? PiercedBy(plan.storeys[storey_idx], face)
                                         : std::vector<Pierced>());
  }
}

Visibility::~Visibility() = default;

bool Visibility::IsSeen(const Vector3d& camera, const Vector3d& point) const {
  const double distance = (point - camera).norm();
  const double end = distance - std::max(kEndGap_m, 0.002 * distance);
  if (end <= 0) return true;
  const Vector3d direction = (point - camera) / distance;
  double begin = 0, free_until = 0;
  for (int i = 0; i < kMaxPassed; ++i) {
    RTCRayHit query;
    query.ray = {static_cast<float>(camera.x()),
                 static_cast<float>(camera.y()),
                 static_cast<float>(camera.z()),
                 static_cast<float>(begin),
                 static_cast<float>(direction.x()),
                 static_cast<float>(direction.y()),
                 static_cast<float>(direction.z()),
                 0,
                 static_cast<float>(end),
                 ~0u,
                 0,
                 0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(impl_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return true;
    const auto face = static_cast<size_t>(impl_->face_of_triangle[query.hit.primID]);
    const double hit = query.ray.tfar;
    if (impl_->normal_of_face[face].dot(direction) < 0) {
      const Vector3d p = camera + hit * direction;
      const std::vector<Pierced>& pierced = impl_->pierced_of_face[face];
      if (std::none_of(pierced.begin(), pierced.end(),
                       [&](const Pierced& opening) { return opening.Holds(p); })) {
        return false;
      }
      free_until = hit;
    } else if (hit - free_until > kMaxWall_m) {
      return false;
    }
    begin = hit + kStep_m;
  }
  return false;
}

}  // namespace enfilade
