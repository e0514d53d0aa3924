// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/plane_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "enfilade/geometry/cross.h"

namespace enfilade {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;

constexpr double kMinBaseline_m = 0.1;
constexpr size_t kMaxHypotheses = 20000;

bool HasBaseline(const PointPair& a, const PointPair& b) {
  return (b.source - a.source).norm() >= kMinBaseline_m &&
         (b.target - a.target).norm() >= kMinBaseline_m;
}

// Least squares on the pairs within reach, again as long as it helps.
Similarity2 Refine(Similarity2 fit, std::span<const PointPair> pairs, bool has_scale) {
  double cost = FitCost(fit, pairs);
  while (true) {
    std::vector<PointPair> inliers;
    for (const PointPair& pair : pairs) {
      if ((fit * pair.source - pair.target).norm() < kFitReach_m) inliers.push_back(pair);
    }
    if (inliers.size() < 2) return fit;
    const Similarity2 refined = FitLeastSquares(inliers, has_scale);
    const double refined_cost = FitCost(refined, pairs);
    if (refined_cost >= cost) return fit;
    fit = refined;
    cost = refined_cost;
  }
}

}  // namespace

Vector2d Similarity2::operator*(const Vector2d& p) const {
  return scale * (Rotation2Dd(angle_rad) * p) + translation;
}

double FitCost(const Similarity2& fit, std::span<const PointPair> pairs) {
  const Eigen::Matrix2d scaled_rotation = fit.scale * Rotation2Dd(fit.angle_rad).matrix();
  double cost = 0;
  for (const PointPair& pair : pairs) {
    const Vector2d left = scaled_rotation * pair.source + fit.translation - pair.target;
    cost += std::min(left.squaredNorm(), kFitReach_m * kFitReach_m);
  }
  return cost;
}

Similarity2 FitLeastSquares(std::span<const PointPair> pairs, bool has_scale) {
  Vector2d source_mean = Vector2d::Zero(), target_mean = Vector2d::Zero();
  for (const PointPair& pair : pairs) {
    source_mean += pair.source / static_cast<double>(pairs.size());
    target_mean += pair.target / static_cast<double>(pairs.size());
  }
  double dot = 0, cross = 0, spread = 0;
  for (const PointPair& pair : pairs) {
    const Vector2d source = pair.source - source_mean, target = pair.target - target_mean;
    dot += source.dot(target);
    cross += Cross(source, target);
    spread += source.squaredNorm();
  }
  Similarity2 fit;
  fit.angle_rad = std::atan2(cross, dot);
  if (has_scale && spread > 0) fit.scale = std::hypot(cross, dot) / spread;
  fit.translation = target_mean - fit.scale * (Rotation2Dd(fit.angle_rad) * source_mean);
  return fit;
}

std::optional<Similarity2> FitRobust(std::span<const PointPair> pairs, bool has_scale) {
  const size_t num_hypotheses =
      pairs.size() * (pairs.size() - std::min<size_t>(pairs.size(), 1)) / 2;
  const size_t stride = std::max<size_t>(1, num_hypotheses / kMaxHypotheses);
  std::optional<Similarity2> best;
  double best_cost = 0;
  size_t count = 0;
  for (size_t j = 1; j < pairs.size(); ++j) {
    for (size_t i = 0; i < j; ++i) {
      if (count++ % stride != 0 || !HasBaseline(pairs[i], pairs[j])) continue;
      const Similarity2 guess =
          FitLeastSquares(std::array<PointPair, 2>{pairs[i], pairs[j]}, has_scale);
      const Similarity2 refined = Refine(guess, pairs, has_scale);
      const double cost = FitCost(refined, pairs);
      if (best && cost >= best_cost) continue;
      best = refined;
      best_cost = cost;
    }
  }
  return best;
}

}  // namespace enfilade
