// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/match_pairs.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "src/sfm/level_rays.h"

namespace enfilade {
namespace {

// A thousandth of the wrong places of floors have so many digits, and a home has some hundred
// pairs. In tour 264 a place of 5 digits in whose direction lay a false one of the features, of 9,
// set two rooms 2 m wrong. What is less clear counts where the features tell the same by
// themselves.
constexpr double kDigitsAlone = 9;
constexpr double kSameTurn_rad = DegToRad(2), kSameDirection_rad = DegToRad(3);

bool IsClearer(const PanoPair& pair, const PanoPair& than) {
  const bool is_same = pair.verdict == PairVerdict::kSamePlace;
  const bool is_other_same = than.verdict == PairVerdict::kSamePlace;
  if (is_same != is_other_same) return is_same;
  return pair.log10_chance < than.log10_chance;
}

bool AreOnePlace(const PanoPair& x, const PanoPair& y) {
  return std::abs(WrapPi(x.Yaw_rad() - y.Yaw_rad())) < kSameTurn_rad &&
         std::acos(std::clamp(x.direction.dot(y.direction), -1.0, 1.0)) < kSameDirection_rad;
}

// What the features say of the place that the floors tell.
PanoPair JudgeFloor(const PairToMatch& pair, const PanoToMatch& a, const PanoToMatch& b,
                    const DescriptorMatchOptions& match, const TwoViewOptions& two_view,
                    const PairHints& hints) {
  const FloorMatch& floor = *pair.floor;
  std::vector<FeatureMatch> matches =
      MatchAtYaw(a.features, a.gravity, b.features, b.gravity, floor.yaw_rad, match);
  matches.insert(matches.end(), pair.followed.begin(), pair.followed.end());
  const TwoViewGeometry geometry{RotationZ(floor.yaw_rad),
                                 Eigen::Vector3d(floor.step.x(), floor.step.y(), 0).normalized()};
  PanoPair judged = JudgePlace(a.level_rays, b.level_rays, matches, floor.spots, geometry,
                               floor.digits, two_view, hints);
  judged.a_idx = pair.a_idx;
  judged.b_idx = pair.b_idx;
  return judged;
}

}  // namespace

LevelRays TurnLevel(std::span<const PanoFeatures> features, std::span<const Gravity> gravity) {
  LevelRays level;
  for (size_t i = 0; i < features.size(); ++i) level.push_back(TurnLevel(features[i], gravity[i]));
  return level;
}

PanoPair MatchPair(const PairToMatch& pair, const PanoToMatch& a, const PanoToMatch& b,
                   const DescriptorMatchOptions& match, const TwoViewOptions& two_view) {
  PairHints hints{HeadingDifference(a.gravity, b.gravity), {}, a.log_sizes, b.log_sizes};
  // Followed features have no descriptors and come last, so the order by a_idx holds.
  const auto estimate = [&](std::vector<FeatureMatch> matches) {
    matches.insert(matches.end(), pair.followed.begin(), pair.followed.end());
    PanoPair estimated = EstimatePair(a.level_rays, b.level_rays, matches, two_view, hints);
    estimated.a_idx = pair.a_idx;
    estimated.b_idx = pair.b_idx;
    return estimated;
  };
  std::optional<PanoPair> best;
  const auto keep_clearer = [&](PanoPair estimated) {
    if (!best || IsClearer(estimated, *best)) best = std::move(estimated);
  };
  for (int turn = 0; turn < kNumTurns; ++turn) {
    if (pair.yaw_rad && turn != TurnOfYaw(a.gravity, b.gravity, *pair.yaw_rad)) continue;
    hints.yaw_rad = YawOfTurn(a.features, a.gravity, b.features, b.gravity, turn);
    if (!hints.yaw_rad) {
      hints.yaw_rad = pair.yaw_rad;
      keep_clearer(
          estimate(MatchDescriptors(a.features.descriptors, b.features.descriptors, match)));
      break;
    }
    keep_clearer(estimate(MatchWalls(a.features, b.features, turn, match)));
  }
  if (pair.floor != nullptr) {
    PanoPair judged = JudgeFloor(pair, a, b, match, two_view, hints);
    if (pair.floor->digits >= kDigitsAlone || AreOnePlace(judged, *best)) {
      keep_clearer(std::move(judged));
    }
  }
  return *best;
}

std::vector<PanoPair> MatchPairs(std::span<const PairToMatch> pairs,
                                 std::span<const PanoFeatures> features,
                                 std::span<const Gravity> gravity, const LevelRays& level,
                                 const DescriptorMatchOptions& match,
                                 const TwoViewOptions& two_view, RunContext& context) {
  std::vector<PanoToMatch> panos;
  for (size_t i = 0; i < features.size(); ++i) panos.push_back({features[i], gravity[i], level[i]});
  std::vector<PanoPair> matched(pairs.size());
  ParallelFor(context, "match pairs", static_cast<int64_t>(pairs.size()), [&](int64_t k) {
    const PairToMatch& pair = pairs[static_cast<size_t>(k)];
    matched[static_cast<size_t>(k)] =
        MatchPair(pair, panos[static_cast<size_t>(pair.a_idx)],
                  panos[static_cast<size_t>(pair.b_idx)], match, two_view);
  });
  return matched;
}

}  // namespace enfilade
