// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "enfilade/base/median.h"
#include "src/model/tile_views.h"

namespace enfilade {
namespace {

constexpr double kMaxQualityCost = 4;
constexpr double kHiddenCost = 6;            ///< for a tile that is hidden altogether
constexpr double kDisagreementScale = 0.15;  ///< of log colour
constexpr double kMaxDisagreementCost = 2;
constexpr int kNumIterations = 12;
constexpr double kDamping = 0.5;

using Costs = std::vector<double>;  // tile by tile, num_labels each

double LogBrightness(const TileView& tile, const Eigen::Vector3d& gain) {
  return std::log(1 + tile.rgb.cast<double>().cwiseProduct(gain).sum());
}

// Views far from the median of at least three show something that stands before the face, or its
// gloss.
void AddDisagreement(size_t tile, const ChartViews& chart_views,
                     const std::vector<Eigen::Vector3d>& gains, Costs& costs) {
  const size_t num_labels = chart_views.views.size();
  std::vector<double> brightness;
  const auto brightness_of = [&](const ChartView& view) {
    return LogBrightness(view.tiles[tile], gains[static_cast<size_t>(view.view_idx)]);
  };
  for (const ChartView& view : chart_views.views) {
    if (view.tiles[tile].seen != 0) brightness.push_back(brightness_of(view));
  }
  if (brightness.size() < 3) return;
  const double median = UpperMedian(std::move(brightness));
  for (size_t l = 0; l < num_labels; ++l) {
    if (chart_views.views[l].tiles[tile].seen == 0) continue;
    const double deviation = std::abs(brightness_of(chart_views.views[l]) - median);
    costs[tile * num_labels + l] += std::min(deviation / kDisagreementScale, kMaxDisagreementCost);
  }
}

Costs DataCosts(const ChartViews& chart_views, const std::vector<Eigen::Vector3d>& gains) {
  const size_t num_labels = chart_views.views.size(), num_tiles = chart_views.inside.size();
  Costs costs(num_tiles * num_labels, 0.0);
  for (size_t tile = 0; tile < num_tiles; ++tile) {
    const int num_inside = std::popcount(chart_views.inside[tile]);
    double best = -1e30;
    for (const ChartView& view : chart_views.views) {
      if (view.tiles[tile].seen != 0) {
        best = std::max(best, static_cast<double>(view.tiles[tile].log_quality));
      }
    }
    if (best == -1e30) continue;  // nobody sees it: free to follow its neighbours
    for (size_t l = 0; l < num_labels; ++l) {
      const TileView& view = chart_views.views[l].tiles[tile];
      const double seen = static_cast<double>(std::popcount(view.seen)) / num_inside;
      const double quality_cost =
          view.seen != 0 ? std::min(best - view.log_quality, kMaxQualityCost) : kMaxQualityCost;
      costs[tile * num_labels + l] = quality_cost + kHiddenCost * (1 - seen);
    }
    AddDisagreement(tile, chart_views, gains, costs);
  }
  return costs;
}

// Min-sum loopy belief propagation for a Potts energy on a grid, all messages at once
// (Felzenszwalb and Huttenlocher, 2006, §3.1: a Potts message needs only one minimum).
class PottsGrid {
 public:
  PottsGrid(int rows, int cols, size_t num_labels, double seam_cost, const Costs& data)
      : rows_(rows), cols_(cols), num_labels_(num_labels), seam_cost_(seam_cost), data_(data) {
    for (Costs& side : messages_) side.assign(data.size(), 0.0);
  }

  void Iterate() {
    std::array<Costs, 4> next = messages_;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < cols_; ++c) {
        for (size_t side = 0; side < 4; ++side) Send(r, c, side, next);
      }
    }
    messages_ = std::move(next);
  }

  [[nodiscard]] size_t BestLabel(size_t tile) const {
    const std::vector<double> belief = Belief(tile);
    return static_cast<size_t>(std::min_element(belief.begin(), belief.end()) - belief.begin());
  }

 private:
  // Sides are left, right, up, down; side ^ 1 is the opposite one.
  static constexpr std::array<std::array<int, 2>, 4> kStep{{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};

  [[nodiscard]] std::vector<double> Belief(size_t tile) const {
    std::vector<double> belief(num_labels_);
    for (size_t l = 0; l < num_labels_; ++l) {
      belief[l] = data_[tile * num_labels_ + l];
      for (const Costs& side : messages_) belief[l] += side[tile * num_labels_ + l];
    }
    return belief;
  }

  // messages_[s][tile] is what the neighbour on side s tells the tile.
  void Send(int r, int c, size_t side, std::array<Costs, 4>& next) const {
    const int nr = r + kStep[side][0], nc = c + kStep[side][1];
    if (nr < 0 || nc < 0 || nr >= rows_ || nc >= cols_) return;
    const auto from = static_cast<size_t>(r * cols_ + c), to = static_cast<size_t>(nr * cols_ + nc);
    std::vector<double> told = Belief(from);
    for (size_t l = 0; l < num_labels_; ++l) told[l] -= messages_[side][from * num_labels_ + l];
    const double least = *std::min_element(told.begin(), told.end());
    for (size_t l = 0; l < num_labels_; ++l) {
      const double message = std::min(told[l] - least, seam_cost_);
      double& target = next[side ^ 1][to * num_labels_ + l];
      target = kDamping * target + (1 - kDamping) * message;
    }
  }

  int rows_, cols_;
  size_t num_labels_;
  double seam_cost_;
  const Costs& data_;
  std::array<Costs, 4> messages_;
};

}  // namespace

std::vector<int> ChooseViews(const Chart& chart, const ChartViews& chart_views,
                             const std::vector<Eigen::Vector3d>& gains, double seam_cost) {
  const size_t num_labels = chart_views.views.size(), num_tiles = chart_views.inside.size();
  std::vector<int> chosen(num_tiles, -1);
  if (num_labels == 0) return chosen;
  const Costs data = DataCosts(chart_views, gains);
  PottsGrid grid(chart.tile_rows, chart.tile_cols, num_labels, seam_cost, data);
  for (int i = 0; i < kNumIterations; ++i) grid.Iterate();
  for (size_t tile = 0; tile < num_tiles; ++tile) {
    const bool is_seen =
        std::any_of(chart_views.views.begin(), chart_views.views.end(),
                    [&](const ChartView& view) { return view.tiles[tile].seen != 0; });
    if (is_seen) chosen[tile] = static_cast<int>(grid.BestLabel(tile));
  }
  return chosen;
}

}  // namespace enfilade
