// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/view_graph.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "enfilade/base/disjoint_sets.h"
#include "enfilade/geometry/angles.h"
#include "src/sfm/pair_graph.h"

namespace enfilade {
namespace {

constexpr double kTripletTolerance_rad = DegToRad(3);
constexpr double kYawLossScale_rad = DegToRad(1);
constexpr double kMaxYawResidual_rad = DegToRad(4);
constexpr int kIterations = 20;
constexpr double kSpring = 1e-9;

double YawBetween(const PanoPair& pair, int from, int to) {
  return pair.a_idx == from && pair.b_idx == to ? pair.Yaw_rad() : -pair.Yaw_rad();
}

// Inliers times what the triplets say.
std::vector<double> Strengths(int num_views, std::span<const PanoPair> pairs) {
  std::map<std::pair<int, int>, size_t> pair_at;
  std::vector<std::vector<int>> neighbours(static_cast<size_t>(num_views));
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (!IsConnecting(pairs[k])) continue;
    pair_at[{pairs[k].a_idx, pairs[k].b_idx}] = k;
    neighbours[static_cast<size_t>(pairs[k].a_idx)].push_back(pairs[k].b_idx);
    neighbours[static_cast<size_t>(pairs[k].b_idx)].push_back(pairs[k].a_idx);
  }
  const auto find = [&](int i, int j) { return pair_at.find({std::min(i, j), std::max(i, j)}); };
  std::vector<double> strengths(pairs.size(), 0);
  for (const auto& [views, k] : pair_at) {
    const auto [a, b] = views;
    double closing = 0, open = 0;
    for (const int c : neighbours[static_cast<size_t>(a)]) {
      const auto bc = find(b, c);
      if (c == b || bc == pair_at.end()) continue;
      const auto ac = find(a, c);
      const double gap = WrapPi(YawBetween(pairs[k], a, b) + YawBetween(pairs[bc->second], b, c) -
                                YawBetween(pairs[ac->second], a, c));
      const double weight = static_cast<double>(
          std::min(pairs[bc->second].inliers.size(), pairs[ac->second].inliers.size()));
      (std::abs(gap) < kTripletTolerance_rad ? closing : open) += weight;
    }
    const double inliers = static_cast<double>(pairs[k].inliers.size());
    strengths[k] = (inliers + closing) * (inliers + closing) / (inliers + closing + open);
  }
  return strengths;
}

std::vector<double> YawsAlong(int num_views, std::span<const PanoPair> pairs,
                              std::span<const size_t> forest) {
  std::vector<double> yaws(static_cast<size_t>(num_views), 0);
  WalkForest(num_views, pairs, forest, [&](int from, int to, const PanoPair& pair) {
    yaws[static_cast<size_t>(to)] =
        WrapPi(yaws[static_cast<size_t>(from)] + YawBetween(pair, from, to));
  });
  return yaws;
}

double YawResidual(const PanoPair& pair, std::span<const double> yaws) {
  return WrapPi(yaws[static_cast<size_t>(pair.b_idx)] - yaws[static_cast<size_t>(pair.a_idx)] -
                pair.Yaw_rad());
}

void ReweightYaws(int num_views, std::span<const PanoPair> pairs, std::vector<double>& yaws) {
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<Eigen::Triplet<double>> entries;
    // A spring far weaker than any pair holds what nothing else holds: one view of each component.
    for (int i = 0; i < num_views; ++i) entries.emplace_back(i, i, kSpring);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(num_views);
    for (const PanoPair& pair : pairs) {
      if (!IsConnecting(pair)) continue;
      const double residual = YawResidual(pair, yaws);
      const double x = residual / kYawLossScale_rad;
      const double weight = std::sqrt(static_cast<double>(pair.inliers.size())) / (1 + x * x);
      entries.emplace_back(pair.a_idx, pair.a_idx, weight);
      entries.emplace_back(pair.b_idx, pair.b_idx, weight);
      entries.emplace_back(pair.a_idx, pair.b_idx, -weight);
      entries.emplace_back(pair.b_idx, pair.a_idx, -weight);
      rhs[pair.a_idx] += weight * residual;
      rhs[pair.b_idx] -= weight * residual;
    }
    Eigen::SparseMatrix<double> matrix(num_views, num_views);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd step =
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(rhs);
    for (size_t i = 0; i < yaws.size(); ++i) {
      yaws[i] = WrapPi(yaws[i] + step[static_cast<Eigen::Index>(i)]);
    }
  }
}

}  // namespace

bool IsConnecting(const PanoPair& pair) {
  return pair.verdict == PairVerdict::kAccepted || pair.verdict == PairVerdict::kSamePlace;
}

std::vector<int> FindComponents(int num_views, std::span<const PanoPair> pairs) {
  DisjointSets sets(num_views);
  for (const PanoPair& pair : pairs) {
    if (IsConnecting(pair)) sets.Join(pair.a_idx, pair.b_idx);
  }
  std::map<int, int> size_of_root;
  for (int i = 0; i < num_views; ++i) ++size_of_root[sets.Find(i)];
  std::vector<std::pair<int, int>> roots(size_of_root.begin(), size_of_root.end());
  std::stable_sort(roots.begin(), roots.end(),
                   [](const auto& x, const auto& y) { return x.second > y.second; });
  std::map<int, int> idx_of_root;
  for (size_t k = 0; k < roots.size(); ++k) idx_of_root[roots[k].first] = static_cast<int>(k);
  std::vector<int> components;
  for (int i = 0; i < num_views; ++i) components.push_back(idx_of_root[sets.Find(i)]);
  return components;
}

std::vector<double> AverageYaws(int num_views, std::vector<PanoPair>& pairs) {
  while (true) {
    const std::vector<double> strengths = Strengths(num_views, pairs);
    std::vector<double> yaws =
        YawsAlong(num_views, pairs, SpanningForest(num_views, pairs, strengths));
    ReweightYaws(num_views, pairs, yaws);
    bool is_changed = false;
    for (PanoPair& pair : pairs) {
      if (!IsConnecting(pair) || std::abs(YawResidual(pair, yaws)) < kMaxYawResidual_rad) continue;
      pair.verdict = PairVerdict::kAgainstTriplets;
      is_changed = true;
    }
    if (!is_changed) return yaws;
  }
}

}  // namespace enfilade
