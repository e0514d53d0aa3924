// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/landscape.h"

#include <cmath>
#include <limits>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr double kSame_rad = DegToRad(0.5);
constexpr double kHighest = 0.5;  // sine of the elevation
constexpr double kApart_rad = DegToRad(1.5);
constexpr int kMinAlike = 4;

// The turn that explains a match; NaN where none does.
double TurnOf(const Vector3d& a, const Vector3d& b) {
  const double climb = std::asin(a.z()) - std::asin(b.z());
  if (std::abs(climb) >= kSame_rad || std::abs(a.z()) >= kHighest) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::atan2(a.y(), a.x()) - std::atan2(b.y(), b.x());
}

}  // namespace

std::vector<size_t> WithoutLandscape(std::span<const Vector3d> rays_a,
                                     std::span<const Vector3d> rays_b) {
  ENFILADE_CHECK(rays_a.size() == rays_b.size());
  std::vector<double> turns_rad;
  for (size_t i = 0; i < rays_a.size(); ++i) turns_rad.push_back(TurnOf(rays_a[i], rays_b[i]));
  std::vector<size_t> kept;
  for (size_t i = 0; i < rays_a.size(); ++i) {
    int num_alike = 0;
    for (size_t k = 0; k < rays_a.size(); ++k) {
      const bool is_apart = (rays_a[i] - rays_a[k]).norm() > kApart_rad;
      num_alike += is_apart && std::abs(WrapPi(turns_rad[i] - turns_rad[k])) < kSame_rad;
    }
    if (num_alike < kMinAlike) kept.push_back(i);
  }
  return kept;
}

}  // namespace enfilade
