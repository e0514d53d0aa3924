// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "enfilade/base/median.h"
#include "src/model/tile_views.h"

namespace enfilade {
namespace {

constexpr float kMinColour = 8, kMaxColour = 247;  // black and white tell nothing of exposure
constexpr size_t kMinShared = 8;                   // tiles
constexpr double kMaxWeight = 200;                 // tiles
constexpr double kPriorWeight = 4;                 // tiles
constexpr double kMinGain = 0.6, kMaxGain = 1.6;

bool IsTelling(const TileView& tile, uint16_t inside) {
  return inside != 0 && tile.seen == inside && tile.rgb.minCoeff() >= kMinColour &&
         tile.rgb.maxCoeff() <= kMaxColour;
}

// Log ratios of the colours of every pair of views on the tiles that both see.
using PairRatios = std::map<std::pair<int, int>, std::vector<Eigen::Vector3d>>;

void CollectRatios(const ChartViews& chart_views, PairRatios& ratios) {
  for (size_t tile = 0; tile < chart_views.inside.size(); ++tile) {
    const uint16_t inside = chart_views.inside[tile];
    for (size_t i = 0; i < chart_views.views.size(); ++i) {
      const TileView& a = chart_views.views[i].tiles[tile];
      if (!IsTelling(a, inside)) continue;
      for (size_t j = i + 1; j < chart_views.views.size(); ++j) {
        const TileView& b = chart_views.views[j].tiles[tile];
        if (!IsTelling(b, inside)) continue;
        ratios[{chart_views.views[i].view_idx, chart_views.views[j].view_idx}].push_back(
            (a.rgb.cast<double>().array().log() - b.rgb.cast<double>().array().log()).matrix());
      }
    }
  }
}

double MedianOfChannel(const std::vector<Eigen::Vector3d>& ratios, int channel) {
  std::vector<double> values;
  for (const Eigen::Vector3d& ratio : ratios) values.push_back(ratio[channel]);
  return UpperMedian(std::move(values));
}

}  // namespace

std::vector<Eigen::Vector3d> EstimateGains(const std::vector<ChartViews>& chart_views,
                                           size_t num_views) {
  PairRatios ratios;
  for (const ChartViews& views : chart_views) CollectRatios(views, ratios);
  const auto n = static_cast<Eigen::Index>(num_views);
  // Normal equations of Σ w (g_i − g_j + m_ij)² + w₀ Σ g², g the log gains; one right side a
  // channel.
  Eigen::MatrixXd normal = kPriorWeight * Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
  for (const auto& [pair, values] : ratios) {
    if (values.size() < kMinShared) continue;
    const auto [i, j] = pair;
    const double weight = std::min(static_cast<double>(values.size()), kMaxWeight);
    normal(i, i) += weight;
    normal(j, j) += weight;
    normal(i, j) -= weight;
    normal(j, i) -= weight;
    for (int k = 0; k < 3; ++k) {
      const double median = MedianOfChannel(values, k);
      right(i, k) -= weight * median;
      right(j, k) += weight * median;
    }
  }
  std::vector<Eigen::Vector3d> gains;
  if (n == 0) return gains;
  const Eigen::MatrixX3d log_gains = normal.ldlt().solve(right);
  for (Eigen::Index i = 0; i < n; ++i) {
    gains.emplace_back(
        log_gains.row(i).array().exp().cwiseMax(kMinGain).cwiseMin(kMaxGain).matrix().transpose());
  }
  return gains;
}

}  // namespace enfilade
