// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/pipeline/cloud_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr size_t kSampleSize = 20000;
constexpr double kTail = 0.02;  // of outliers at each end
constexpr double kMargin_m = 0.5;
constexpr double kMinShareInside = 0.5;
// A camera sees a hall from its middle and no more: so much larger than the cameras' spread.
constexpr double kMaxExtentRatio = 10, kReach_m = 5;
constexpr double kMinCameraHeight_m = 0.2;
constexpr double kMinShareFacing = 0.7;

double Quantile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::vector<double> Coordinates(const std::vector<Vector3d>& positions, int axis) {
  std::vector<double> values;
  values.reserve(positions.size());
  for (const Vector3d& position : positions) values.push_back(position[axis]);
  return values;
}

}  // namespace

CloudFit::CloudFit(const PointCloud& cloud, std::span<const int> view_of,
                   std::span<const View> views) {
  for (const View& view : views) cameras_.push_back(view.world_from_cam.translation);
  const size_t step = std::max<size_t>(1, cloud.points.size() / kSampleSize);
  for (size_t i = 0; i < cloud.points.size(); i += step) {
    const ScenePoint& point = cloud.points[i];
    for (const int image : point.view_idx) {
      const int view_idx = view_of[static_cast<size_t>(image)];
      if (view_idx >= 0 && !point.normal.isZero(0))
        sights_.push_back({positions_.size(), cameras_[static_cast<size_t>(view_idx)]});
    }
    positions_.push_back(point.position);
    normals_.push_back(point.normal);
  }
}

double CloudFit::ShareFacing(const Eigen::Affine3d& world_from_cloud) const {
  const auto is_facing = [&](const Sight& sight) {
    const Vector3d ray = world_from_cloud * positions_[sight.point_idx] - sight.camera;
    return (world_from_cloud.linear() * normals_[sight.point_idx]).dot(ray) < 0;
  };
  return static_cast<double>(std::count_if(sights_.begin(), sights_.end(), is_facing)) /
         static_cast<double>(sights_.size());
}

std::string CloudFit::Problem(const Eigen::Affine3d& world_from_cloud) const {
  std::vector<Vector3d> positions;
  positions.reserve(positions_.size());
  for (const Vector3d& position : positions_) positions.push_back(world_from_cloud * position);
  Vector3d low, high, cameras_low = cameras_.front(), cameras_high = cameras_.front();
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> values = Coordinates(positions, axis);
    low[axis] = Quantile(values, kTail);
    high[axis] = Quantile(values, 1 - kTail);
  }
  for (const Vector3d& camera : cameras_) {
    cameras_low = cameras_low.cwiseMin(camera);
    cameras_high = cameras_high.cwiseMax(camera);
  }
  const auto num_outside = std::count_if(cameras_.begin(), cameras_.end(), [&](const Vector3d& c) {
    return (c.array() < low.array() - kMargin_m).any() ||
           (c.array() > high.array() + kMargin_m).any();
  });
  const auto num_cameras = static_cast<double>(cameras_.size());
  if (static_cast<double>(num_outside) > (1 - kMinShareInside) * num_cameras) {
    return fmt::format("{} of {} cameras stand outside it", num_outside, cameras_.size());
  }
  const double extent_m = (high - low).head<2>().norm();
  const double spread_m = (cameras_high - cameras_low).head<2>().norm();
  if (extent_m > kMaxExtentRatio * (spread_m + kReach_m)) {
    return fmt::format("it is {:.3g} m across and the cameras are {:.3g} m apart", extent_m,
                       spread_m);
  }
  const double camera_z = Quantile(Coordinates(cameras_, 2), 0.5);
  if (camera_z - low.z() < kMinCameraHeight_m) {
    return fmt::format("its lowest points are at {:.2f} m and the cameras at {:.2f} m, not above",
                       low.z(), camera_z);
  }
  const double share_facing = sights_.empty() ? 1 : ShareFacing(world_from_cloud);
  if (share_facing < kMinShareFacing) {
    return fmt::format("of its normals {:.0f} % turn away from the cameras that see them",
                       100 * (1 - share_facing));
  }
  return "";
}

}  // namespace enfilade
