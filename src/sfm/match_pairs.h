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

namespace enfilade {

/// The features' rays of every view in its level frame.
using LevelRays = std::vector<std::vector<Eigen::Vector3d>>;
[[nodiscard]] LevelRays TurnLevel(std::span<const PanoFeatures> features,
                                  std::span<const Gravity> gravity);

/// Two panoramas to compare and what is known of them beforehand.
struct PairToMatch {
  int a_idx = 0, b_idx = 0;                      ///< views, a_idx < b_idx
  std::optional<double> heading_difference_rad;  ///< as for EstimatePair
  std::vector<FeatureMatch> followed;            ///< matches beside those of the descriptors
};

/// Matches the descriptors of each pair and estimates how the two stand to each other
/// (EstimatePair); the result has the order of `pairs`. Runs in parallel over the pairs.
[[nodiscard]] std::vector<PanoPair> MatchPairs(std::span<const PairToMatch> pairs,
                                               std::span<const PanoFeatures> features,
                                               const LevelRays& level,
                                               const DescriptorMatchOptions& match,
                                               const TwoViewOptions& two_view, RunContext& context);

}  // namespace enfilade
