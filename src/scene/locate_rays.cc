// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/locate_rays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

// atan(x) for x in [0, 1] with an error below 2e-8 (Abramowitz and Stegun 1964, 4.4.49).
inline float AtanUnit(float x) {
  const float t = x * x;
  float p = 0.0028662257f;
  p = p * t - 0.0161657367f;
  p = p * t + 0.0429096138f;
  p = p * t - 0.0752896400f;
  p = p * t + 0.1065626393f;
  p = p * t - 0.1420889944f;
  p = p * t + 0.1999355085f;
  p = p * t - 0.3333314528f;
  return x + x * (t * p);
}

// std::atan2 without branches, so that the compiler makes vector code of the loop round it.
inline float FastAtan2(float y, float x) {
  constexpr float kFloatPi = static_cast<float>(kPi);
  const float abs_x = std::abs(x), abs_y = std::abs(y);
  const float larger = std::max(std::max(abs_x, abs_y), 1e-30f);  // 0/0 at the poles
  float angle = AtanUnit(std::min(abs_x, abs_y) / larger);
  angle = abs_y > abs_x ? 0.5f * kFloatPi - angle : angle;
  angle = x < 0 ? kFloatPi - angle : angle;
  return y < 0 ? -angle : angle;
}

}  // namespace

void LocateRays(const Eigen::Vector3d& first, const Eigen::Vector3d& step, int cols, int rows,
                std::span<float> u, std::span<float> v) {
  ENFILADE_CHECK(u.size() == v.size());
  const int size = static_cast<int>(u.size());
  const float x0 = static_cast<float>(first.x()), dx = static_cast<float>(step.x());
  const float y0 = static_cast<float>(first.y()), dy = static_cast<float>(step.y());
  const float z0 = static_cast<float>(first.z()), dz = static_cast<float>(step.z());
  const float u_per_rad = static_cast<float>(cols / (2 * kPi));
  const float v_per_rad = static_cast<float>(rows / kPi);
  const float u_center = 0.5f * static_cast<float>(cols) - 0.5f;
  const float v_center = 0.5f * static_cast<float>(rows) - 0.5f;
  float* to_u = u.data();
  float* to_v = v.data();
  for (int i = 0; i < size; ++i) {
    const float t = static_cast<float>(i);
    const float x = x0 + t * dx, y = y0 + t * dy, z = z0 + t * dz;
    to_u[i] = u_center + u_per_rad * FastAtan2(x, z);
    to_v[i] = v_center + v_per_rad * FastAtan2(y, std::sqrt(x * x + z * z));
  }
}

}  // namespace enfilade
