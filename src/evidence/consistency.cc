// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>

#include "sensor_model.h"
#include "view_evidence.h"

namespace enfilade {
namespace {

constexpr float kWindow =
    0.1f;  // metres of the running mean: about the blocked depth behind a wall

float TrustBehind(float log_odds) { return std::min(1.0f, 2 / (1 + std::exp(-log_odds - 0.5f))); }

// Trust at every edge of the distance bins along one direction.
class ColumnWalk {
 public:
  ColumnWalk(const EvidenceGrids& grids, const SensorModel& model, const AccumulateOptions& options,
             float far_m)
      : grids_(grids), model_(model), options_(options), far_m_(far_m) {}

  void Walk(const PolarView& view, const RangeBins& bins, const Eigen::Vector2d& direction,
            float* trust) const {
    const auto step = static_cast<float>(grids_.frame.cell_m);
    const auto window = static_cast<size_t>(std::max(1.0f, std::round(kWindow / step)));
    std::deque<float> recent;
    float sum = 0, lowest = 1;
    int edge = 0;
    for (float r = kRoomRoundCamera; r < far_m_; r += step) {
      while (edge <= bins.size() && bins.edge_m(edge) <= r) trust[edge++] = lowest;
      const Eigen::Vector2d offset = static_cast<double>(r) * direction;
      const Eigen::Vector2d p = view.origin() + offset;
      const int row = grids_.frame.Row(p.y()), col = grids_.frame.Col(p.x());
      if (!grids_.frame.IsInside(row, col)) break;
      const float own = OwnFree(view, offset.cast<float>(), r);
      if (own <= 0) break;  // claims nothing beyond
      recent.push_back(grids_.free(row, col) - own);
      sum += recent.back();
      if (recent.size() > window) {
        sum -= recent.front();
        recent.pop_front();
      }
      if (recent.size() == window)
        lowest = std::min(lowest, TrustBehind(sum / static_cast<float>(window)));
    }
    while (edge <= bins.size()) trust[edge++] = lowest;
  }

 private:
  // What the view said of the cell, at full weight.
  float OwnFree(const PolarView& view, const Eigen::Vector2f& offset, float r) const {
    const Eigen::Vector2f unit = offset / r;
    const float half_width =
        0.5f * static_cast<float>(grids_.frame.cell_m) * (std::abs(unit.x()) + std::abs(unit.y()));
    const auto reading =
        view.Read(offset, r, half_width, static_cast<float>(options_.blocked_depth_m));
    return reading ? model_.Evaluate(*reading, r, half_width, 1).free : 0;
  }

  const EvidenceGrids& grids_;
  const SensorModel& model_;
  const AccumulateOptions& options_;
  float far_m_;
};

}  // namespace

void DistrustContradictedColumns(const EvidenceGrids& grids, ViewEvidence& evidence,
                                 RunContext& context) {
  const SensorModel model(evidence.options);
  const ColumnWalk walk(grids, model, evidence.options, evidence.far_m);
  ParallelFor(context, "evidence", static_cast<int64_t>(evidence.views.size()), [&](int64_t v) {
    PolarView& view = evidence.views[v];
    std::vector<float> trust;
    const int stride = view.bins().size() + 1;
    trust.resize(static_cast<size_t>(view.num_columns()) * static_cast<size_t>(stride));
    for (int c = 0; c < view.num_columns(); ++c) {
      walk.Walk(view, view.bins(), view.Direction(c), trust.data() + c * stride);
    }
    view.set_trust(std::move(trust));
  });
}

}  // namespace enfilade
