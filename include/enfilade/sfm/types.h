// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/descriptor_matcher.h"

namespace enfilade {

/// The point features of one panorama, pooled over its virtual views (ExtractFeatures). The first m
/// ≤ n have descriptors; the others were followed through a film.
struct PanoFeatures {
  std::vector<Eigen::Vector3f> rays;  ///< n unit rays in the camera frame
  std::vector<float> sizes_rad;       ///< m diameters, largest first
  std::vector<uint8_t> walls;         ///< m wall views that show them (0 … 5), or none: not told
  DescriptorSet descriptors;          ///< m × 128, upright

  [[nodiscard]] int size() const { return static_cast<int>(rays.size()); }
};

/// Features of two panoramas that show the same.
struct PairMatches {
  int a_idx = 0, b_idx = 0;  ///< views, a_idx < b_idx
  std::vector<FeatureMatch> matches;
};

/// Where the floors of two panoramas lie on each other best, in a's level frame.
struct FloorMatch {
  int a_idx = 0, b_idx = 0;         ///< views, a_idx < b_idx
  double yaw_rad = 0;               ///< of b
  Eigen::Vector2d step{0, 0};       ///< from a to b, camera heights
  double digits = 0;                ///< how clear it is, as −PanoPair::log10_chance counts
  std::vector<FeatureMatch> spots;  ///< of the floor: features without descriptors, ascending
};

/// How a panorama's lines say that it stands.
struct Gravity {
  Eigen::Vector3d up_in_cam{0, -1, 0};  ///< unit, upward in the camera frame
  double sigma_rad = 0.02;              ///< standard deviation about each level axis
  int num_lines = 0;                    ///< vertical lines that agree with it
  /// Azimuth of the walls in the level frame, modulo 90°; none where lines run in all directions.
  std::optional<double> heading_rad;
};

/// What became of a pair of panoramas that was matched.
enum class PairVerdict {
  kAccepted,         ///< a baseline direction and a rotation that chance does not explain
  kSamePlace,        ///< a rotation alone explains the matches: taken from one place
  kFewMatches,       ///< too few matches to say anything
  kChance,           ///< what agrees may agree by chance
  kAgainstTriplets,  ///< contradicts the rotations that other pairs agree on
  kAgainstPositions  ///< contradicts where the other pairs place the two
};
[[nodiscard]] std::span<const std::string_view> EnumNames(PairVerdict);

/// Two panoramas and how they stand to each other, both in their level frames (x right of the
/// picture's centre, y towards it, z up).
struct PanoPair {
  int a_idx = 0, b_idx = 0;  ///< views, a_idx < b_idx
  PairVerdict verdict = PairVerdict::kFewMatches;
  int num_matches = 0;                                     ///< before verification
  std::vector<FeatureMatch> inliers;                       ///< ascending in a_idx
  Eigen::Matrix3d a_from_b = Eigen::Matrix3d::Identity();  ///< rotation
  Eigen::Vector3d direction{1, 0, 0};  ///< unit, from a to b, in a's level frame
  double log10_chance = 0;             ///< expected number of such agreements among random matches
  double parallax_rad = 0;             ///< median over the inliers
  double length = 0;                   ///< of the baseline in camera heights, 0 = unknown
  double length_sigma = 0;             ///< of log(length)

  [[nodiscard]] double Yaw_rad() const { return YawOf(a_from_b); }
};

}  // namespace enfilade
