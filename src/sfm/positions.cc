// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/positions.h"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <map>

#include "enfilade/base/disjoint_sets.h"
#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/two_view.h"
#include "enfilade/sfm/view_graph.h"
#include "src/sfm/pair_graph.h"

namespace enfilade {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr size_t kMinShared = 3;
constexpr double kFeatureSigma = 0.15;  // of the logarithm of one feature's ratio of distances
constexpr double kMinRatioSigma = 0.03;
constexpr double kUnknownLength = 1.5;  // camera heights, where nothing tells
constexpr double kUnknownSigma = 1.0;
constexpr double kAcross_rad = DegToRad(1.5);
constexpr double kSamePlaceSigma = 0.03;
constexpr double kMinSigma = 0.01;
constexpr double kMaxMiss_rad = DegToRad(10);
constexpr double kShortest = 0.1;  // below this a direction of the result means nothing
constexpr int kIterations = 30;
// Cauchy's loss in standard deviations. Wide at first (graduated non-convexity): else the wrong
// pairs of the tree hold what they have built, since the right ones miss it by many standard
// deviations.
constexpr double kLossScale = 2, kWidestScale = 64, kNarrowing = 0.8;
constexpr double kSpring = 1e-9;

// Distance in baselines from view `view_idx` to each of its features that the pair matches.
std::map<int, double> DistancesFrom(int view_idx, const PanoPair& pair,
                                    std::span<const std::vector<Vector3d>> level_rays) {
  std::map<int, double> distances;
  const TwoViewGeometry geometry{pair.a_from_b, pair.direction};
  for (const FeatureMatch& match : pair.inliers) {
    const PairDepths depths = TriangulateDepths(
        geometry, level_rays[static_cast<size_t>(pair.a_idx)][static_cast<size_t>(match.a_idx)],
        level_rays[static_cast<size_t>(pair.b_idx)][static_cast<size_t>(match.b_idx)]);
    const bool is_a = pair.a_idx == view_idx;
    const double distance = is_a ? depths.a : depths.b;
    constexpr double kFarthest = 20;  // baselines: farther ones are too vague
    if (distance > 0 && distance < kFarthest) {
      distances[is_a ? match.a_idx : match.b_idx] = distance;
    }
  }
  return distances;
}

// Symmetric systems of `size` unknowns.
class NormalEquations {
 public:
  explicit NormalEquations(int size) : rhs_(Eigen::VectorXd::Zero(size)) {
    for (int i = 0; i < size; ++i) Add(i, i, kSpring);
  }
  void Add(int row, int col, double value) { entries_.emplace_back(row, col, value); }
  double& rhs(int row) { return rhs_[row]; }
  [[nodiscard]] Eigen::VectorXd Solve() const {
    Eigen::SparseMatrix<double> matrix(rhs_.size(), rhs_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(rhs_);
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd rhs_;
};

// The vector from a to b that a pair tells, and how surely (inverse covariance), in world.
struct Step {
  Vector2d vector;
  Matrix2d information;
};

Step StepOf(const PanoPair& pair, std::span<const double> yaws) {
  if (pair.verdict == PairVerdict::kSamePlace) {
    return {Vector2d::Zero(), Matrix2d::Identity() / (kSamePlaceSigma * kSamePlaceSigma)};
  }
  const Vector2d direction =
      (Eigen::Rotation2Dd(yaws[static_cast<size_t>(pair.a_idx)]) * pair.direction.head<2>())
          .normalized();
  const double length = pair.length > 0 ? pair.length : kUnknownLength;
  const double sigma = pair.length > 0 ? pair.length_sigma : kUnknownSigma;
  const double along = std::max(kMinSigma, length * sigma);
  const double across = std::max(kMinSigma, length * kAcross_rad);
  const Matrix2d projection = direction * direction.transpose();
  return {length * direction,
          projection / (along * along) + (Matrix2d::Identity() - projection) / (across * across)};
}

std::vector<Vector2d> PositionsAlong(std::span<const PanoPair> pairs,
                                     std::span<const double> yaws) {
  const int num_views = static_cast<int>(yaws.size());
  std::vector<double> strengths;
  for (const PanoPair& pair : pairs) {
    const double sureness = pair.length > 0 ? 1 / (0.02 + pair.length_sigma) : 1;
    strengths.push_back(std::sqrt(static_cast<double>(pair.inliers.size())) * sureness);
  }
  std::vector<Vector2d> positions(yaws.size(), Vector2d::Zero());
  WalkForest(num_views, pairs, SpanningForest(num_views, pairs, strengths),
             [&](int from, int to, const PanoPair& pair) {
               const double sign = pair.a_idx == from ? 1 : -1;
               positions[static_cast<size_t>(to)] =
                   positions[static_cast<size_t>(from)] + sign * StepOf(pair, yaws).vector;
             });
  return positions;
}

void Reweight(std::span<const PanoPair> pairs, std::span<const double> yaws,
              std::vector<Vector2d>& positions) {
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const double scale = std::max(kLossScale, kWidestScale * std::pow(kNarrowing, iteration));
    NormalEquations equations(2 * static_cast<int>(positions.size()));
    for (const PanoPair& pair : pairs) {
      if (!IsConnecting(pair)) continue;
      const Step step = StepOf(pair, yaws);
      const Vector2d miss = step.vector - (positions[static_cast<size_t>(pair.b_idx)] -
                                           positions[static_cast<size_t>(pair.a_idx)]);
      const double squared_sigmas = miss.dot(step.information * miss);
      const Matrix2d weight = step.information / (1 + squared_sigmas / (scale * scale));
      const Vector2d pull = weight * miss;
      for (int r = 0; r < 2; ++r) {
        const int a = 2 * pair.a_idx, b = 2 * pair.b_idx;
        for (int c = 0; c < 2; ++c) {
          equations.Add(a + r, a + c, weight(r, c));
          equations.Add(b + r, b + c, weight(r, c));
          equations.Add(a + r, b + c, -weight(r, c));
          equations.Add(b + r, a + c, -weight(r, c));
        }
        equations.rhs(a + r) -= pull[r];
        equations.rhs(b + r) += pull[r];
      }
    }
    const Eigen::VectorXd change = equations.Solve();
    for (size_t i = 0; i < positions.size(); ++i) {
      positions[i] += change.segment<2>(2 * static_cast<Eigen::Index>(i));
    }
  }
}

bool IsAgainst(const PanoPair& pair, std::span<const double> yaws,
               std::span<const Vector2d> positions) {
  const Vector2d apart =
      positions[static_cast<size_t>(pair.b_idx)] - positions[static_cast<size_t>(pair.a_idx)];
  if (pair.verdict == PairVerdict::kSamePlace) return apart.norm() > 5 * kSamePlaceSigma;
  if (apart.norm() < kShortest) return false;
  const Vector2d told = StepOf(pair, yaws).vector.normalized();
  return std::acos(std::clamp(told.dot(apart.normalized()), -1.0, 1.0)) > kMaxMiss_rad;
}

}  // namespace

std::vector<LengthRatio> CollectLengthRatios(std::span<const PanoPair> pairs,
                                             std::span<const std::vector<Vector3d>> level_rays) {
  std::vector<std::vector<int>> pairs_at(level_rays.size());
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].verdict != PairVerdict::kAccepted) continue;
    pairs_at[static_cast<size_t>(pairs[k].a_idx)].push_back(static_cast<int>(k));
    pairs_at[static_cast<size_t>(pairs[k].b_idx)].push_back(static_cast<int>(k));
  }
  std::vector<LengthRatio> ratios;
  for (size_t view = 0; view < level_rays.size(); ++view) {
    std::vector<std::map<int, double>> distances;
    for (const int k : pairs_at[view]) {
      distances.push_back(
          DistancesFrom(static_cast<int>(view), pairs[static_cast<size_t>(k)], level_rays));
    }
    for (size_t i = 0; i < distances.size(); ++i) {
      for (size_t j = i + 1; j < distances.size(); ++j) {
        std::vector<double> shared;
        for (const auto& [feature, distance] : distances[i]) {
          const auto other = distances[j].find(feature);
          if (other != distances[j].end()) shared.push_back(std::log(other->second / distance));
        }
        if (shared.size() < kMinShared) continue;
        const double count = static_cast<double>(shared.size());
        ratios.push_back({pairs_at[view][i], pairs_at[view][j], UpperMedian(shared),
                          std::max(kMinRatioSigma, kFeatureSigma / std::sqrt(count))});
      }
    }
  }
  return ratios;
}

void SolveLengths(std::span<const LengthRatio> ratios, std::vector<PanoPair>& pairs) {
  const int num_pairs = static_cast<int>(pairs.size());
  DisjointSets sets(num_pairs);
  for (const LengthRatio& ratio : ratios) sets.Join(ratio.pair_idx, ratio.other_idx);
  std::vector<bool> is_told(pairs.size(), false);
  Eigen::VectorXd logs = Eigen::VectorXd::Zero(num_pairs);
  for (int k = 0; k < num_pairs; ++k) {
    const PanoPair& pair = pairs[static_cast<size_t>(k)];
    if (pair.length <= 0) continue;
    logs[k] = std::log(pair.length);
    is_told[static_cast<size_t>(sets.Find(k))] = true;
  }
  Eigen::VectorXd diagonal;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    NormalEquations equations(num_pairs);
    diagonal = Eigen::VectorXd::Zero(num_pairs);
    for (int k = 0; k < num_pairs; ++k) {
      const PanoPair& pair = pairs[static_cast<size_t>(k)];
      if (pair.length <= 0) continue;
      const double miss = std::log(pair.length) - logs[k];
      const double x = miss / pair.length_sigma;
      const double weight = 1 / (pair.length_sigma * pair.length_sigma * (1 + x * x / 4));
      equations.Add(k, k, weight);
      equations.rhs(k) += weight * miss;
      diagonal[k] += weight;
    }
    for (const LengthRatio& ratio : ratios) {
      const int i = ratio.pair_idx, j = ratio.other_idx;
      const double miss = ratio.log_ratio - (logs[i] - logs[j]);
      const double x = miss / ratio.sigma;
      const double weight = 1 / (ratio.sigma * ratio.sigma * (1 + x * x / 4));
      equations.Add(i, i, weight);
      equations.Add(j, j, weight);
      equations.Add(i, j, -weight);
      equations.Add(j, i, -weight);
      equations.rhs(i) += weight * miss;
      equations.rhs(j) -= weight * miss;
      diagonal[i] += weight;
      diagonal[j] += weight;
    }
    logs += equations.Solve();
  }
  for (int k = 0; k < num_pairs; ++k) {
    PanoPair& pair = pairs[static_cast<size_t>(k)];
    if (pair.verdict != PairVerdict::kAccepted || !is_told[static_cast<size_t>(sets.Find(k))]) {
      continue;
    }
    pair.length = std::exp(logs[k]);
    pair.length_sigma = std::max(kMinRatioSigma, 1 / std::sqrt(std::max(1.0, diagonal[k])));
  }
}

std::vector<Vector2d> SolvePositions(std::span<const double> yaws, std::vector<PanoPair>& pairs) {
  while (true) {
    std::vector<Vector2d> positions = PositionsAlong(pairs, yaws);
    Reweight(pairs, yaws, positions);
    bool is_changed = false;
    for (PanoPair& pair : pairs) {
      if (!IsConnecting(pair) || !IsAgainst(pair, yaws, positions)) continue;
      pair.verdict = PairVerdict::kAgainstPositions;
      is_changed = true;
    }
    if (!is_changed) return positions;
  }
}

}  // namespace enfilade
