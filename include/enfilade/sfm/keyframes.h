// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/scene/camera.h"
#include "enfilade/sfm/klt_tracker.h"

namespace enfilade {

struct KeyframeOptions {
  double min_parallax_deg = 2.5;
  double min_shared_share = 0.4;

  void Visit(OptionVisitor& v) {
    v("min_parallax_deg", min_parallax_deg,
      "Median angle by which features have moved since the last keyframe, beyond the camera's "
      "turn, that makes a keyframe; degrees.",
      {0.0, 90.0});
    v("min_shared_share", min_shared_share,
      "Share of the last keyframe's features that must be left; before it falls lower, there is a "
      "keyframe.",
      {0.0, 1.0});
  }
};

/// The rotation second_from_first that takes unit rays of one frame to those of another with the
/// least sum of angles, to first order: Kabsch's solution (Acta Crystallographica 1976), reweighted
/// by the inverse angles, so that a minority of rays that moved by themselves has little say.
/// Requires arrays of equal size. None for fewer than three rays, and where all are parallel.
[[nodiscard]] std::optional<Eigen::Matrix3d> FitRotation(
    std::span<const Eigen::Vector3d> first_rays, std::span<const Eigen::Vector3d> second_rays);

/// Median angle between second rays and first rays turned by FitRotation, radians: what only a
/// movement of the camera explains. None where there is no rotation.
[[nodiscard]] std::optional<double> MedianParallax(std::span<const Eigen::Vector3d> first_rays,
                                                   std::span<const Eigen::Vector3d> second_rays);

/// Frames worth keeping, by rising index: the first one; then each frame whose median parallax to
/// the last keyframe reaches min_parallax_deg; and the last frame before so many features are lost
/// that less than min_shared_share of the keyframe's are left. `camera` took all frames. In narrow
/// pictures a sideways step looks much like a turn, so that parallax there is underrated.
[[nodiscard]] std::vector<int> SelectKeyframes(std::span<const TrackedFrame> frames,
                                               const Camera& camera,
                                               const KeyframeOptions& options);

}  // namespace enfilade
