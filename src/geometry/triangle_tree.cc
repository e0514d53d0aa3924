// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/triangle_tree.h"

#include <embree3/rtcore.h>

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

}  // namespace enfilade
