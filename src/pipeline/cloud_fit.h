// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "enfilade/exchange/point_cloud_reader.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// Tells whether a cloud and the cameras of a scene can be of one world.
class CloudFit {
 public:
  /// `view_of` gives the view of each image that the cloud counts, −1 for none.
  CloudFit(const PointCloud& cloud, std::span<const int> view_of, std::span<const View> views);

  /// Why they cannot, the cloud brought into the scene's world by a similarity; empty when nothing
  /// speaks against it.
  [[nodiscard]] std::string Problem(const Eigen::Affine3d& world_from_cloud) const;

 private:
  [[nodiscard]] double ShareFacing(const Eigen::Affine3d& world_from_cloud) const;

  // A point of the cloud and a camera that sees it.
  struct Sight {
    size_t point_idx = 0;
    Eigen::Vector3d camera;
  };

  std::vector<Eigen::Vector3d> cameras_;
  std::vector<Eigen::Vector3d> positions_;  // a sample, in the cloud's world
  std::vector<Eigen::Vector3d> normals_;
  std::vector<Sight> sights_;
};

}  // namespace enfilade
