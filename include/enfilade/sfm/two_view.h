// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

struct TwoViewOptions {
  double inlier_deg = 0.5;
  double tilt_sigma_deg = 0.3;
  double climb_sigma_deg = 3.0;
  int min_inliers = 8;
  double max_log10_chance = -6.0;

  void Visit(OptionVisitor& v) {
    v("inlier_deg", inlier_deg,
      "A match agrees when its rays are this near to a common plane with "
      "the baseline.",
      {0.05, 3.0});
    v("tilt_sigma_deg", tilt_sigma_deg,
      "Expected error of the panoramas' verticals: how freely a pair may lean.", {0.01, 10.0});
    v("climb_sigma_deg", climb_sigma_deg,
      "Expected slope of the line between two cameras on one storey.", {0.01, 45.0});
    v("min_inliers", min_inliers, "Fewest agreeing matches of a pair.", {5.0, 1000.0});
    v("max_log10_chance", max_log10_chance,
      "A pair counts when random matches would agree as well fewer than 10 to this times.",
      {-100.0, 0.0});
  }
};

/// How two panoramas see a common scene: rays of b turned by a_from_b lie in one plane with those
/// of a and the direction.
struct TwoViewGeometry {
  Eigen::Matrix3d a_from_b = Eigen::Matrix3d::Identity();
  Eigen::Vector3d direction{1, 0, 0};  ///< unit, from a to b, in a's frame
};

/// Angle by which both rays together miss a common plane with the direction (Sampson distance on
/// the sphere, first order), radians, signed.
[[nodiscard]] double EpipolarError(const TwoViewGeometry& geometry, const Eigen::Vector3d& ray_a,
                                   const Eigen::Vector3d& ray_b);

/// Distances along both rays, in baselines, to the point where they pass each other; negative
/// behind a camera. Infinite for parallel rays.
struct PairDepths {
  double a = 0, b = 0;
};
[[nodiscard]] PairDepths TriangulateDepths(const TwoViewGeometry& geometry,
                                           const Eigen::Vector3d& ray_a,
                                           const Eigen::Vector3d& ray_b);

/// What is known of a pair of panoramas beside the rays of its matches.
struct PairHints {
  /// Yaw of b in a's level frame modulo 90°, as the walls tell it.
  std::optional<double> heading_difference_rad;
  /// The yaw itself, to some degrees: no other is tried.
  std::optional<double> yaw_rad;
  /// Logarithms of the sizes that the features of a and b would have at unit distance, up to a
  /// constant; empty: unknown.
  std::span<const double> log_sizes_a, log_sizes_b;
};

/// The relative pose of two panoramas from matched features, all rays in level frames.
///
/// Upright model: for every yaw on a grid each match votes for the level directions of the baseline
/// that it allows; the best candidates are refined (rotation with a soft tilt prior, direction with
/// a soft prior on its slope; Cauchy's loss) and judged by the matches that agree and lie in front
/// of both cameras, each counted by its parallax.
///
/// The result is accepted when random pairs of the same features would hardly agree as well (an
/// a-contrario test after Moisan and Stival, IJCV 2004, whose chance of a single agreement is
/// measured on shifted matches). When a rotation alone explains the matches the verdict is
/// kSamePlace.
///
/// A yaw more than 4° off the heading difference of the hints, if known, needs far stronger
/// evidence. Where sizes are known, those of a match have to be as its distances (within a factor
/// of 1.5). Fills all of PanoPair but length and length_sigma. Cost: O(matches · yaws).
[[nodiscard]] PanoPair EstimatePair(std::span<const Eigen::Vector3d> level_rays_a,
                                    std::span<const Eigen::Vector3d> level_rays_b,
                                    std::span<const FeatureMatch> matches,
                                    const TwoViewOptions& options, const PairHints& hints = {});

/// What matches say of a place that something else tells, where `spots` are matches too (of the
/// floor), with so many digits of chance for it: `geometry` is refined over both near where it is,
/// the matches are counted as EstimatePair does, but for one hypothesis, and the digits are added.
/// Accepted by the same bound.
[[nodiscard]] PanoPair JudgePlace(std::span<const Eigen::Vector3d> level_rays_a,
                                  std::span<const Eigen::Vector3d> level_rays_b,
                                  std::span<const FeatureMatch> matches,
                                  std::span<const FeatureMatch> spots,
                                  const TwoViewGeometry& geometry, double digits,
                                  const TwoViewOptions& options, const PairHints& hints = {});

}  // namespace enfilade
