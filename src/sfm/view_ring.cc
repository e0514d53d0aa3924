// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/view_ring.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "src/sfm/wall_view.h"

namespace enfilade {
namespace {

constexpr double kMinFocal_px = 32;

// Pinhole views with the panorama's resolution at their centres.
Camera ViewCamera(const Camera& pano, double half_width_rad, double half_height_rad) {
  ENFILADE_CHECK(pano.model == CameraModel::kEquirectangular);
  const double focal_px = std::max(kMinFocal_px, pano.width / (2 * kPi));
  const int half_width = static_cast<int>(std::lround(focal_px * std::tan(half_width_rad)));
  const int half_height = static_cast<int>(std::lround(focal_px * std::tan(half_height_rad)));
  return PinholeCamera(2 * half_width, 2 * half_height, focal_px, focal_px, half_width,
                       half_height);
}

}  // namespace

bool ViewRing::Owns(int view_idx, const Eigen::Vector3d& ray_in_pano) const {
  const Eigen::Vector3d ray =
      pano_from_view[static_cast<size_t>(view_idx)].transpose() * ray_in_pano;
  const auto is_within = [&](double off_axis, double owned) {
    return off_axis >= -owned * ray.z() && off_axis < owned * ray.z();
  };
  return is_within(ray.x(), owned_x) && is_within(ray.y(), owned_y);
}

ViewRing MakeViewRing(const Camera& pano) {
  constexpr int kNumViews = 8;
  ViewRing ring{ViewCamera(pano, DegToRad(30), DegToRad(45)), {}, std::tan(kPi / kNumViews), 2};
  for (int k = 0; k < kNumViews; ++k) {
    ring.pano_from_view.push_back(
        Eigen::AngleAxisd(2 * kPi * k / kNumViews, Eigen::Vector3d::UnitY()).toRotationMatrix());
  }
  return ring;
}

ViewRing MakeWallViews(const Camera& pano, const Eigen::Matrix3d& pano_from_walls) {
  constexpr double kHalf_rad = DegToRad(62), kOwned_rad = DegToRad(60);
  const double owned = std::tan(kOwned_rad);
  ViewRing ring{ViewCamera(pano, kHalf_rad, kHalf_rad), {}, owned, owned};
  for (int k = 0; k < kNumWallViews; ++k) {
    ring.pano_from_view.push_back(pano_from_walls * WallViewFrame(k));
  }
  return ring;
}

}  // namespace enfilade
