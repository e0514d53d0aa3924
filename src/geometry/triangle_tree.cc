// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/triangle_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"

namespace enfilade {

using Eigen::Vector3f;

struct TriangleTree::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

RTCRay MakeRay(const Vector3f& origin, const Vector3f& direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = static_cast<unsigned>(-1);
  return ray;
}

// Rays from one origin, four at a time.
constexpr size_t kLanes = 4;

struct alignas(16) Lanes {
  int is_used[kLanes];
};

// Fills a packet with rays first … first + 3; those beyond the end are not used.
Lanes FillPacket(const Vector3f& origin, std::span<const Vector3f> directions, size_t first,
                 RTCRay4& rays) {
  Lanes lanes;
  for (size_t i = 0; i < kLanes; ++i) {
    lanes.is_used[i] = first + i < directions.size() ? -1 : 0;
    const Vector3f& direction = directions[std::min(first + i, directions.size() - 1)];
    rays.org_x[i] = origin.x();
    rays.org_y[i] = origin.y();
    rays.org_z[i] = origin.z();
    rays.dir_x[i] = direction.x();
    rays.dir_y[i] = direction.y();
    rays.dir_z[i] = direction.z();
    rays.time[i] = 0;
    rays.mask[i] = static_cast<unsigned>(-1);
    rays.id[i] = rays.flags[i] = 0;
  }
  return lanes;
}

RTCIntersectContext CoherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void FillBuffers(RTCGeometry geometry, const std::vector<Vector3f>& vertices,
                 const std::vector<std::array<int, 3>>& triangles) {
  auto* coordinates = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  for (const Vector3f& p : vertices) {
    for (int k = 0; k < 3; ++k) *coordinates++ = p[k];
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), triangles.size()));
  for (const std::array<int, 3>& triangle : triangles) {
    for (const int corner : triangle) *indices++ = static_cast<unsigned>(corner);
  }
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Vector3f>& vertices,
                           const std::vector<std::array<int, 3>>& triangles)
    : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice("threads=1,set_affinity=0,isa=sse4.2");
  if (impl_->device == nullptr) {
    throw DependencyError("Embree", "cannot start", "use an x86-64 processor with SSE 4.2");
  }
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  if (!triangles.empty()) {
    const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    FillBuffers(geometry, vertices, triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
  if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) {
    throw DependencyError("Embree", "cannot build its tree", "free some memory");
  }
}

TriangleTree::~TriangleTree() = default;

std::optional<TriangleHit> TriangleTree::FirstHit(const Vector3f& origin, const Vector3f& direction,
                                                  float near, float far) const {
  RTCRayHit query{};
  query.ray = MakeRay(origin, direction, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return TriangleHit{static_cast<int>(query.hit.primID), query.ray.tfar};
}

bool TriangleTree::IsHit(const Vector3f& origin, const Vector3f& direction, float near,
                         float far) const {
  if (far < near) return false;  // Embree marks a hit by a negative far end
  RTCRay ray = MakeRay(origin, direction, near, far);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar < 0;
}

void TriangleTree::FirstHits(const Vector3f& origin, std::span<const Vector3f> directions,
                             float near, float far,
                             std::span<std::optional<TriangleHit>> hits) const {
  ENFILADE_CHECK(directions.size() == hits.size());
  RTCIntersectContext context = CoherentContext();
  for (size_t first = 0; first < directions.size(); first += kLanes) {
    RTCRayHit4 query;
    const Lanes lanes = FillPacket(origin, directions, first, query.ray);
    std::fill_n(query.ray.tnear, kLanes, near);
    std::fill_n(query.ray.tfar, kLanes, far);
    std::fill_n(query.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], kLanes, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect4(lanes.is_used, impl_->scene, &context, &query);
    for (size_t i = 0; i < kLanes && first + i < hits.size(); ++i) {
      hits[first + i] = std::nullopt;
      if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + i] = TriangleHit{static_cast<int>(query.hit.primID[i]), query.ray.tfar[i]};
    }
  }
}

void TriangleTree::AreHit(const Vector3f& origin, std::span<const Vector3f> directions, float near,
                          std::span<const float> far, std::span<bool> are_hit) const {
  ENFILADE_CHECK(directions.size() == far.size() && directions.size() == are_hit.size());
  RTCIntersectContext context = CoherentContext();
  for (size_t first = 0; first < directions.size(); first += kLanes) {
    RTCRay4 rays;
    const Lanes lanes = FillPacket(origin, directions, first, rays);
    std::fill_n(rays.tnear, kLanes, near);
    for (size_t i = 0; i < kLanes; ++i)
      rays.tfar[i] = far[std::min(first + i, directions.size() - 1)];
    rtcOccluded4(lanes.is_used, impl_->scene, &context, &rays);
    for (size_t i = 0; i < kLanes && first + i < far.size(); ++i) {
      // Embree marks a hit by a negative far end.
      are_hit[first + i] = rays.tfar[i] < 0 && far[first + i] >= near;
    }
  }
}

}  // namespace enfilade
