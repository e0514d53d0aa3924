// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/view_ring.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr int kNumViews = 8;
constexpr double kHalfWidth_rad = DegToRad(30);
constexpr double kHalfHeight_rad = DegToRad(45);
constexpr double kMinFocal_px = 32;

}  // namespace

bool ViewRing::Owns(int view_idx, const Eigen::Vector3d& ray_in_pano) const {
  const double step = 2 * kPi / static_cast<double>(pano_from_view.size());
  const double azimuth = std::atan2(ray_in_pano.x(), ray_in_pano.z());
  const int num_views = static_cast<int>(pano_from_view.size());
  const int nearest = static_cast<int>(std::floor(azimuth / step + 0.5));
  return (nearest % num_views + num_views) % num_views == view_idx;
}

ViewRing MakeViewRing(const Camera& pano) {
  ENFILADE_CHECK(pano.model == CameraModel::kEquirectangular);
  const double focal_px = std::max(kMinFocal_px, pano.width / (2 * kPi));
  const int half_width = static_cast<int>(std::lround(focal_px * std::tan(kHalfWidth_rad)));
  const int half_height = static_cast<int>(std::lround(focal_px * std::tan(kHalfHeight_rad)));
  ViewRing ring{
      PinholeCamera(2 * half_width, 2 * half_height, focal_px, focal_px, half_width, half_height),
      {}};
  for (int k = 0; k < kNumViews; ++k) {
    ring.pano_from_view.push_back(
        Eigen::AngleAxisd(2 * kPi * k / kNumViews, Eigen::Vector3d::UnitY()).toRotationMatrix());
  }
  return ring;
}

}  // namespace enfilade
