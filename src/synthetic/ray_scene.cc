// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/ray_scene.h"

#include <embree3/rtcore.h>

#include <limits>

#include "enfilade/base/errors.h"

namespace enfilade {

using Eigen::Vector3f;

struct RayScene::State {
  const std::vector<Surface>* surfaces = nullptr;
  std::vector<int> surface_of_triangle;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

constexpr float kNear_m = 1e-4f;

RTCRay MakeRay(const Vector3f& origin, const Vector3f& direction, float far) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = kNear_m;
  ray.tfar = far;
  ray.mask = static_cast<unsigned>(-1);
  return ray;
}

void FillBuffers(RTCGeometry geometry, const std::vector<Surface>& surfaces,
                 std::vector<int>& surface_of_triangle) {
  size_t num_vertices = 0, num_triangles = 0;
  for (const Surface& surface : surfaces) {
    num_vertices += surface.vertices.size();
    num_triangles += surface.triangles.size();
  }
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), num_vertices));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), num_triangles));
  unsigned first = 0;
  for (size_t s = 0; s < surfaces.size(); ++s) {
    for (const Eigen::Vector2f& uv : surfaces[s].vertices) {
      const Vector3f p = surfaces[s].Point(uv.x(), uv.y());
      for (int k = 0; k < 3; ++k) *vertices++ = p[k];
    }
    for (const std::array<int, 3>& triangle : surfaces[s].triangles) {
      for (const int corner : triangle) *indices++ = first + static_cast<unsigned>(corner);
      surface_of_triangle.push_back(static_cast<int>(s));
    }
    first += static_cast<unsigned>(surfaces[s].vertices.size());
  }
}

}  // namespace

RayScene::RayScene(const std::vector<Surface>& surfaces) : state_(std::make_unique<State>()) {
  state_->surfaces = &surfaces;
  // One instruction set and one building thread: the same tree, and so the same bytes, everywhere.
  state_->device = rtcNewDevice("threads=1,set_affinity=0,isa=sse4.2");
  if (state_->device == nullptr) {
    throw DependencyError("Embree", "cannot start", "use an x86-64 processor with SSE 4.2");
  }
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  FillBuffers(geometry, surfaces, state_->surface_of_triangle);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(state_->scene);
  if (rtcGetDeviceError(state_->device) != RTC_ERROR_NONE) {
    throw DependencyError("Embree", "cannot build its tree", "free some memory");
  }
}

RayScene::~RayScene() = default;

std::optional<RayHit> RayScene::Trace(const Vector3f& origin, const Vector3f& direction) const {
  RTCRayHit query{};
  query.ray = MakeRay(origin, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  RayHit hit;
  hit.surface_idx = state_->surface_of_triangle[query.hit.primID];
  hit.distance_m = query.ray.tfar;
  const Surface& surface = (*state_->surfaces)[static_cast<size_t>(hit.surface_idx)];
  const Vector3f offset = origin + hit.distance_m * direction - surface.origin;
  hit.u = surface.axis_u.dot(offset);
  hit.v = surface.axis_v.dot(offset);
  return hit;
}

bool RayScene::IsBlocked(const Vector3f& from, const Vector3f& to) const {
  const Vector3f offset = to - from;
  const float distance_m = offset.norm();
  RTCRay ray = MakeRay(from, offset / distance_m, distance_m - kNear_m);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace enfilade
