// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/pair_length.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/two_view.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr double kRaySigma_rad = DegToRad(0.2);
constexpr double kMinParallax_rad = DegToRad(1);
constexpr double kMinElevation_rad = DegToRad(4);
constexpr double kOneSpot_rad = DegToRad(1.5);
constexpr double kMinSigma = 0.03;  // floors are not that level, cameras not that equally high
constexpr double kMaxSigma = 0.25;
// A point that would lie beyond its plane counts this much against a length.
constexpr double kBeyondCost = 0.7;
constexpr double kMinScore = 2.5;
// Lengths that are tried: 2 cm to 30 m for cameras at 1.5 m, in steps of 1 %.
const double kMinLogLength = std::log(0.013), kMaxLogLength = std::log(20.0);
constexpr double kLogStep = 0.01;
const int kNumLengths = static_cast<int>((kMaxLogLength - kMinLogLength) / kLogStep) + 1;
// Ceilings that are tried: 0.3 m above the cameras to 3 m.
const double kMinLogCeiling = std::log(0.2), kMaxLogCeiling = std::log(2.2);
const int kNumCeilings = static_cast<int>((kMaxLogCeiling - kMinLogCeiling) / kLogStep) + 1;

struct ScoredLength {
  double log_length = 0;
  double score = 0;
};

double ScoreOf(const LengthVote& vote, double log_length) {
  const double x = (log_length - vote.log_length) / vote.sigma;
  const double score = std::exp(-0.5 * x * x) - kBeyondCost * std::clamp((x - 2) / 2, 0.0, 1.0);
  return vote.weight * score;
}

// Scores of the votes from above or from below at the lengths kLogStep apart from `first` on.
std::vector<double> Scores(std::span<const LengthVote> votes, bool is_above, double first,
                           int count) {
  std::vector<double> scores(static_cast<size_t>(count), 0);
  for (const LengthVote& vote : votes) {
    if (vote.is_above != is_above) continue;
    for (int i = 0; i < count; ++i) {
      scores[static_cast<size_t>(i)] += ScoreOf(vote, first + i * kLogStep);
    }
  }
  return scores;
}

ScoredLength BestLength(std::span<const LengthVote> votes, double ceiling) {
  std::vector<double> scores = Scores(votes, false, kMinLogLength, kNumLengths);
  if (ceiling > 0) {
    const std::vector<double> above =
        Scores(votes, true, kMinLogLength - std::log(ceiling), kNumLengths);
    for (size_t i = 0; i < scores.size(); ++i) scores[i] += above[i];
  }
  const auto best = std::max_element(scores.begin(), scores.end());
  if (*best <= 0) return {};
  return {kMinLogLength + kLogStep * static_cast<double>(best - scores.begin()), *best};
}

}  // namespace

std::vector<LengthVote> CollectLengthVotes(const PanoPair& pair,
                                           std::span<const Vector3d> level_rays_a,
                                           std::span<const Vector3d> level_rays_b) {
  std::vector<LengthVote> votes;
  std::vector<Vector3d> directions;
  const TwoViewGeometry geometry{pair.a_from_b, pair.direction};
  for (const FeatureMatch& match : pair.inliers) {
    const Vector3d& a = level_rays_a[static_cast<size_t>(match.a_idx)];
    const Vector3d& b = level_rays_b[static_cast<size_t>(match.b_idx)];
    const double parallax = std::asin(std::min(1.0, a.cross(geometry.a_from_b * b).norm()));
    const PairDepths depths = TriangulateDepths(geometry, a, b);
    const bool is_steep = std::abs(a.z()) > std::sin(kMinElevation_rad);
    if (parallax < kMinParallax_rad || !is_steep || depths.a <= 0 || depths.b <= 0) continue;
    const double height = depths.a * a.z();
    const double sigma = kRaySigma_rad * std::hypot(depths.b / std::sin(parallax),
                                                    1 / std::tan(std::asin(std::abs(a.z()))));
    if (sigma > kMaxSigma) continue;
    votes.push_back({-std::log(std::abs(height)), std::max(sigma, kMinSigma), height > 0});
    directions.push_back(a);
  }
  for (size_t i = 0; i < votes.size(); ++i) {
    const auto num_near =
        std::count_if(directions.begin(), directions.end(),
                      [&](const Vector3d& d) { return (d - directions[i]).norm() < kOneSpot_rad; });
    votes[i].weight = 1.0 / static_cast<double>(num_near);
  }
  return votes;
}

double FindCeiling(std::span<const std::vector<LengthVote>> votes_of_pairs) {
  bool has_above = false;
  for (const auto& votes : votes_of_pairs) {
    for (const LengthVote& vote : votes) has_above = has_above || vote.is_above;
  }
  if (!has_above) return 0;
  // A ceiling a step higher shifts the scores of the votes from above by a step.
  std::vector<double> totals(static_cast<size_t>(kNumCeilings), 0);
  for (const auto& votes : votes_of_pairs) {
    const std::vector<double> below = Scores(votes, false, kMinLogLength, kNumLengths);
    const double first_above = kMinLogLength - kMinLogCeiling - (kNumCeilings - 1) * kLogStep;
    const std::vector<double> above =
        Scores(votes, true, first_above, kNumLengths + kNumCeilings - 1);
    for (int c = 0; c < kNumCeilings; ++c) {
      const double* const shifted = above.data() + (kNumCeilings - 1 - c);
      double best = 0;
      for (int i = 0; i < kNumLengths; ++i) {
        best = std::max(best, below[static_cast<size_t>(i)] + shifted[i]);
      }
      totals[static_cast<size_t>(c)] += best;
    }
  }
  const auto best = std::max_element(totals.begin(), totals.end());
  return std::exp(kMinLogCeiling + kLogStep * static_cast<double>(best - totals.begin()));
}

void SetLength(std::span<const LengthVote> votes, double ceiling, PanoPair& pair) {
  const ScoredLength best = BestLength(votes, ceiling);
  pair.length = 0;
  if (best.score < kMinScore) return;
  double information = 0;
  for (const LengthVote& vote : votes) {
    if (vote.is_above && ceiling <= 0) continue;
    const double at = vote.log_length + (vote.is_above ? std::log(ceiling) : 0);
    const double x = (best.log_length - at) / vote.sigma;
    information += vote.weight * std::exp(-0.5 * x * x) / (vote.sigma * vote.sigma);
  }
  pair.length = std::exp(best.log_length);
  pair.length_sigma = std::max(kMinSigma, 1 / std::sqrt(information));
}

}  // namespace enfilade
