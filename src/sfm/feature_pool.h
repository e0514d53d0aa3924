// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/view_ring.h"

namespace enfilade {

/// Gathers the features of a panorama's virtual views, each from the views that own its direction.
class FeaturePool {
 public:
  /// References must outlive the pool. `trusted` is 0 where features are not wanted.
  FeaturePool(const Camera& pano, const ViewRing& ring, const ImageU8& trusted)
      : pano_(pano), ring_(ring), trusted_(trusted) {}

  /// Takes a feature of a view unless the view does not own its direction or the pixel is not
  /// trusted. `pixel` and `size_px` are the view's; `root_sift` are 128 values from 0 to 1;
  /// `strength` says which features are kept where there are too many.
  void Add(int view_idx, const Eigen::Vector2d& pixel, double size_px, double strength,
           const float* root_sift);

  /// The strongest `max_features`, in the order of size, then direction.
  [[nodiscard]] PanoFeatures Take(int max_features);

 private:
  const Camera& pano_;
  const ViewRing& ring_;
  const ImageU8& trusted_;
  std::vector<Eigen::Vector3f> rays_;
  std::vector<float> sizes_rad_;
  std::vector<float> strengths_;
  std::vector<uint8_t> views_;
  std::vector<uint8_t> descriptors_;
};

}  // namespace enfilade
