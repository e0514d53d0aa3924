// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/descriptor_matcher.h"
#include "enfilade/sfm/two_view.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/wall_matches.h"

namespace enfilade {

/// The features' rays of every view in its level frame.
using LevelRays = std::vector<std::vector<Eigen::Vector3d>>;
[[nodiscard]] LevelRays TurnLevel(std::span<const PanoFeatures> features,
                                  std::span<const Gravity> gravity);

/// Two panoramas to compare and what is known of them beforehand.
struct PairToMatch {
  int a_idx = 0, b_idx = 0;                 ///< views, a_idx < b_idx
  std::optional<double> yaw_rad = {};       ///< of b in a's level frame, where it is known
  std::vector<FeatureMatch> followed = {};  ///< matches beside those of the descriptors
  const FloorMatch* floor = nullptr;        ///< where their floors lie on each other, if known
};

/// A panorama as it is compared. References must outlive it.
struct PanoToMatch {
  const PanoFeatures& features;
  const Gravity& gravity;
  std::span<const Eigen::Vector3d> level_rays;
  std::vector<double> log_sizes = LogSizes(features, level_rays, gravity);
};

/// Matches the descriptors of two panoramas, wall by wall for each of the four quarter turns or,
/// where walls are not known, all with all, and estimates how the two stand to each other
/// (EstimatePair): of the turns the one that chance explains least. The place that the floors tell
/// is judged as well (JudgePlace), with what chance gives the floors.
[[nodiscard]] PanoPair MatchPair(const PairToMatch& pair, const PanoToMatch& a,
                                 const PanoToMatch& b, const DescriptorMatchOptions& match,
                                 const TwoViewOptions& two_view);

/// MatchPair for each of the pairs, in their order. Runs in parallel over the pairs.
[[nodiscard]] std::vector<PanoPair> MatchPairs(std::span<const PairToMatch> pairs,
                                               std::span<const PanoFeatures> features,
                                               std::span<const Gravity> gravity,
                                               const LevelRays& level,
                                               const DescriptorMatchOptions& match,
                                               const TwoViewOptions& two_view, RunContext& context);

}  // namespace enfilade
