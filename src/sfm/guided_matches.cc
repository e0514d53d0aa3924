// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/guided_matches.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/tracks.h"
#include "src/sfm/level_rays.h"
#include "src/sfm/wall_matches.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr double kMinParallax_rad = DegToRad(1.5);
constexpr size_t kNumShifts = 4;
constexpr double kMinGain = 4;
constexpr size_t kMinMatches = 8;

// Rays of one pair's matches in world, and the baseline.
struct PlacedPair {
  TwoViewGeometry geometry;  // rotation: none, as rays are in world
  std::vector<Vector3d> rays_a, rays_b;

  [[nodiscard]] bool Agrees(size_t a, size_t b, double bound_rad) const {
    if (std::abs(EpipolarError(geometry, rays_a[a], rays_b[b])) > bound_rad) return false;
    if (rays_a[a].cross(rays_b[b]).norm() < kMinParallax_rad) return false;
    const PairDepths depths = TriangulateDepths(geometry, rays_a[a], rays_b[b]);
    return depths.a > 0 && depths.b > 0;
  }
};

std::vector<FeatureMatch> AgreeingMatches(const PlacedPair& placed,
                                          std::span<const FeatureMatch> matches, double bound_rad) {
  std::vector<FeatureMatch> agreeing;
  double by_chance = 0;
  for (size_t i = 0; i < matches.size(); ++i) {
    if (placed.Agrees(i, i, bound_rad)) agreeing.push_back(matches[i]);
    for (size_t s = 1; s <= kNumShifts; ++s) {
      const size_t other = (i + s * matches.size() / (kNumShifts + 1) + 1) % matches.size();
      by_chance += placed.Agrees(i, other, bound_rad) ? 1.0 / kNumShifts : 0.0;
    }
  }
  const auto count = static_cast<double>(agreeing.size());
  if (agreeing.size() < kMinMatches || count < kMinGain * by_chance) return {};
  return agreeing;
}

// Takes over those of `wider` whose feature three views show: what only two do is still too often
// false.
void KeepSeenThrice(std::span<const PanoFeatures> features, std::span<const PanoPair> wider,
                    std::vector<PanoPair>& pairs) {
  std::vector<std::vector<char>> is_seen_thrice(features.size());
  for (size_t i = 0; i < features.size(); ++i) {
    is_seen_thrice[i].assign(static_cast<size_t>(features[i].size()), 0);
  }
  for (const Track& track : BuildTracks(wider, features)) {
    if (track.observations.size() < 3) continue;
    for (const Observation& seen : track.observations) {
      is_seen_thrice[static_cast<size_t>(seen.view_idx)][static_cast<size_t>(seen.feature_idx)] = 1;
    }
  }
  for (size_t k = 0; k < pairs.size(); ++k) {
    const auto a = static_cast<size_t>(pairs[k].a_idx), b = static_cast<size_t>(pairs[k].b_idx);
    const std::vector<FeatureMatch> before =
        pairs[k].verdict == PairVerdict::kAccepted ? pairs[k].inliers : std::vector<FeatureMatch>();
    std::vector<FeatureMatch> kept;
    for (const FeatureMatch& match : wider[k].inliers) {
      const bool is_known =
          std::any_of(before.begin(), before.end(), [&](const FeatureMatch& other) {
            return other.a_idx == match.a_idx && other.b_idx == match.b_idx;
          });
      if (is_known || (is_seen_thrice[a][static_cast<size_t>(match.a_idx)] != 0 &&
                       is_seen_thrice[b][static_cast<size_t>(match.b_idx)] != 0)) {
        kept.push_back(match);
      }
    }
    if (kept.size() <= before.size() || wider[k].verdict != PairVerdict::kAccepted) continue;
    pairs[k].inliers = std::move(kept);
    pairs[k].verdict = PairVerdict::kAccepted;
  }
}

}  // namespace

void MatchGuided(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                 const RegisterOptions& options, RunContext& context, Registration& registration) {
  std::vector<PanoPair> wider = registration.pairs;
  std::vector<PanoPair*> pairs;
  for (PanoPair& pair : wider) {
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    const double distance =
        (registration.world_from_cam[a].translation - registration.world_from_cam[b].translation)
            .norm();
    const bool is_one = registration.component_idx[a] == registration.component_idx[b];
    if (is_one && pair.verdict != PairVerdict::kSamePlace && distance < options.guided_reach) {
      pairs.push_back(&pair);
    }
  }
  DescriptorMatchOptions loose = options.match;
  loose.max_ratio = std::max(loose.max_ratio, options.guided_ratio);
  ParallelFor(context, "match again", static_cast<int64_t>(pairs.size()), [&](int64_t k) {
    PanoPair& pair = *pairs[static_cast<size_t>(k)];
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    const Rigid3 &pose_a = registration.world_from_cam[a], &pose_b = registration.world_from_cam[b];
    const std::vector<FeatureMatch> matches =
        MatchAtYaw(features[a], gravity[a], features[b], gravity[b],
                   YawBetween(pose_a, pose_b, gravity[a], gravity[b]), loose);
    PlacedPair placed;
    placed.geometry.direction = (pose_b.translation - pose_a.translation).normalized();
    for (const FeatureMatch& match : matches) {
      placed.rays_a.push_back(pose_a.rotation *
                              features[a].rays[static_cast<size_t>(match.a_idx)].cast<double>());
      placed.rays_b.push_back(pose_b.rotation *
                              features[b].rays[static_cast<size_t>(match.b_idx)].cast<double>());
    }
    std::vector<FeatureMatch> agreeing =
        AgreeingMatches(placed, matches, DegToRad(options.guided_deg));
    // What a film's tracks tell has no descriptor to be matched again.
    for (const FeatureMatch& match : pair.inliers) {
      if (match.a_idx >= features[a].descriptors.size()) agreeing.push_back(match);
    }
    if (agreeing.size() <= pair.inliers.size()) return;
    pair.inliers = std::move(agreeing);
    pair.verdict = PairVerdict::kAccepted;
  });
  const std::vector<PanoPair> before = registration.pairs;
  KeepSeenThrice(features, wider, registration.pairs);
  for (size_t k = 0; k < before.size(); ++k) {
    PanoPair& pair = registration.pairs[k];
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    if (pair.verdict == before[k].verdict) continue;
    SetGeometry(registration.world_from_cam[a], registration.world_from_cam[b], gravity[a],
                gravity[b], pair);
  }
}

}  // namespace enfilade
