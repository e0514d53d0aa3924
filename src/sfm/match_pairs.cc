// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/match_pairs.h"

#include "src/sfm/level_rays.h"

namespace enfilade {

LevelRays TurnLevel(std::span<const PanoFeatures> features, std::span<const Gravity> gravity) {
  LevelRays level;
  for (size_t i = 0; i < features.size(); ++i) level.push_back(TurnLevel(features[i], gravity[i]));
  return level;
}

std::vector<PanoPair> MatchPairs(std::span<const PairToMatch> pairs,
                                 std::span<const PanoFeatures> features, const LevelRays& level,
                                 const DescriptorMatchOptions& match,
                                 const TwoViewOptions& two_view, RunContext& context) {
  std::vector<PanoPair> matched(pairs.size());
  ParallelFor(context, "match pairs", static_cast<int64_t>(pairs.size()), [&](int64_t k) {
    const PairToMatch& pair = pairs[static_cast<size_t>(k)];
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    std::vector<FeatureMatch> matches =
        MatchDescriptors(features[a].descriptors, features[b].descriptors, match);
    // Followed features have no descriptors and come last, so the order by a_idx holds.
    matches.insert(matches.end(), pair.followed.begin(), pair.followed.end());
    PanoPair& result = matched[static_cast<size_t>(k)];
    result = EstimatePair(level[a], level[b], matches, two_view, pair.heading_difference_rad);
    result.a_idx = pair.a_idx;
    result.b_idx = pair.b_idx;
  });
  return matched;
}

}  // namespace enfilade
