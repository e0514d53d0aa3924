// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "view_evidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "sensor_model.h"

namespace enfilade {
namespace {

constexpr int kRowsPerTask = 8;

// Directions from which a cell is seen free.
class SupportCollector {
 public:
  void Add(uint8_t bit) { bits_ |= bit; }
  void AddDirection(const Eigen::Vector2f& unit, float max_cosine) {
    if ((bits_ & kSupportTwoDirections) != 0) return;
    for (const Eigen::Vector2f& other : directions_) {
      if (unit.dot(other) <= max_cosine) bits_ |= kSupportTwoDirections;
    }
    directions_.push_back(unit);
  }
  uint8_t TakeBits() {
    directions_.clear();
    return std::exchange(bits_, uint8_t{0});
  }

 private:
  uint8_t bits_ = 0;
  std::vector<Eigen::Vector2f> directions_;
};

// Adds up rows of cells. One view after the other runs along the row, so that its table stays in
// the cache and neighbouring cells use neighbouring columns.
class RowAccumulator {
 public:
  RowAccumulator(const ViewEvidence& in, EvidenceGrids& grids)
      : in_(in),
        grids_(grids),
        model_(in.options),
        max_cosine_(static_cast<float>(std::cos(DegToRad(in.options.min_angle_deg)))),
        support_(static_cast<size_t>(grids.frame.cols)) {}

  void Fill(int row) {
    std::fill_n(grids_.free.row(row), grids_.frame.cols, 0.0f);
    std::fill_n(grids_.wall.row(row), grids_.frame.cols, 0.0f);
    for (size_t v = 0; v < in_.views.size(); ++v) {
      for (int col = 0; col < grids_.frame.cols; ++col) AddView(v, row, col);
    }
    for (int col = 0; col < grids_.frame.cols; ++col) {
      grids_.support(row, col) = support_[col].TakeBits();
    }
  }

 private:
  void AddView(size_t v, int row, int col) {
    const AccumulateOptions& options = in_.options;
    const Eigen::Vector2f offset =
        (grids_.frame.Center(row, col) - in_.views[v].origin()).cast<float>();
    const float r = offset.norm();
    const auto cell_m = static_cast<float>(options.cell_m);
    if (r > in_.far_m) return;
    if (r < 0.5f * cell_m) {  // the camera's own cell has no direction
      const float own = SensorModel::Quantised(options.max_view_log_odds * in_.weights[v]);
      grids_.free(row, col) += own;
      grids_.wall(row, col) -= own;
      support_[col].Add(kSupportNear);
      return;
    }
    const Eigen::Vector2f unit = offset / r;
    const float half_width = 0.5f * cell_m * (std::abs(unit.x()) + std::abs(unit.y()));
    const auto depth = static_cast<float>(options.blocked_depth_m);
    const auto reading = in_.views[v].Read(offset, r, half_width, depth);
    if (!reading) return;
    const CellLogOdds log_odds = model_.Evaluate(*reading, r, half_width, in_.weights[v]);
    grids_.free(row, col) += log_odds.free;
    grids_.wall(row, col) += log_odds.wall;
    const float free_probability = reading->trust * (1 - reading->cdf_far) +
                                   (1 - reading->trust) * SensorModel::FreeIfUnexplained(r);
    if (free_probability < options.min_support_probability) return;
    if (r <= reading->obstacle_m) {
      support_[col].Add(r <= static_cast<float>(options.near_m) ? kSupportNear : kSupportFar);
    }
    support_[col].AddDirection(unit, max_cosine_);
  }

  const ViewEvidence& in_;
  EvidenceGrids& grids_;
  SensorModel model_;
  float max_cosine_;
  std::vector<SupportCollector> support_;  // by column of the grid
};

}  // namespace

void AccumulateViews(const ViewEvidence& in, EvidenceGrids& grids, RunContext& context) {
  const int num_tasks = (grids.frame.rows + kRowsPerTask - 1) / kRowsPerTask;
  ParallelFor(context, "evidence", num_tasks, [&](int64_t task) {
    RowAccumulator accumulator(in, grids);
    const int begin = static_cast<int>(task) * kRowsPerTask;
    const int end = std::min(begin + kRowsPerTask, grids.frame.rows);
    for (int row = begin; row < end; ++row) accumulator.Fill(row);
  });
}

std::vector<double> WeightsByPlace(const std::vector<PolarView>& views, double same_place_m) {
  std::vector<double> weights;
  for (const PolarView& a : views) {
    double crowd = 0;
    for (const PolarView& b : views) {
      const double distance = (a.origin() - b.origin()).norm();
      const double closeness = &a == &b           ? 1
                               : same_place_m > 0 ? std::max(0.0, 1 - distance / same_place_m)
                                                  : 0;
      // Quantised, so that the sum is exact in any order.
      crowd += std::round(closeness * 4096) / 4096;
    }
    weights.push_back(1 / crowd);
  }
  return weights;
}

}  // namespace enfilade
