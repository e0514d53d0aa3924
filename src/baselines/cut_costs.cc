// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/cut_costs.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr double kMaxScaled = 255;
constexpr double kMaxCost = 1e7;
// Dearer than the evidence of a cell and its four sides can be.
constexpr int32_t kForced = 100'000'000;

int32_t ToCapacity(double cost) {
  return static_cast<int32_t>(std::lround(std::clamp(cost, 0.0, kMaxCost)));
}

// Of the cells that have any.
double MeanCount(const ImageF& counts) {
  double sum = 0;
  int64_t num_cells = 0;
  for (const float count : counts.data()) {
    sum += count;
    num_cells += count > 0;
  }
  return num_cells > 0 ? sum / static_cast<double>(num_cells) : 1;
}

// 100 for one and a half times what is good, nothing below half of it.
void ScaleCounts(const ImageF& counts, double good, std::vector<int32_t>& capacity) {
  for (size_t i = 0; i < capacity.size(); ++i) {
    capacity[i] = ToCapacity(std::min(100 * (counts.data()[i] / good - 0.5), kMaxScaled));
  }
}

// The points in a cell grow with its area, the rays across it with its width.
void AddCounts(const EvidenceGrids& evidence, const PlaneCutOptions& options,
               GridCutProblem& problem) {
  const double width = evidence.frame.cell_m / options.reference_cell_m;
  const double good_points = options.good_wall_points > 0
                                 ? options.good_wall_points * width * width
                                 : options.good_wall_share * MeanCount(evidence.wall);
  const double good_rays = options.good_free_rays > 0
                               ? options.good_free_rays * width
                               : options.good_free_share * MeanCount(evidence.free);
  ScaleCounts(evidence.wall, good_points, problem.sink_capacity);
  ScaleCounts(evidence.free, good_rays, problem.source_capacity);
}

void AddLogOdds(const EvidenceGrids& evidence, const PlaneCutOptions& options,
                GridCutProblem& problem) {
  for (size_t i = 0; i < problem.source_capacity.size(); ++i) {
    const double inside =
        options.log_odds_scale * (evidence.free.data()[i] - evidence.wall.data()[i]);
    problem.source_capacity[i] = ToCapacity(inside);
    problem.sink_capacity[i] = ToCapacity(-inside);
  }
}

void ForceBorderOutside(GridCutProblem& problem) {
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      const bool is_border =
          row == 0 || col == 0 || row + 1 == problem.rows || col + 1 == problem.cols;
      if (!is_border) continue;
      problem.source_capacity[problem.Index(row, col)] = 0;
      problem.sink_capacity[problem.Index(row, col)] = kForced;
    }
  }
}

}  // namespace

GridCutProblem MakeCutProblem(const EvidenceGrids& evidence, const PlaneCutOptions& options) {
  GridCutProblem problem;
  problem.rows = evidence.frame.rows;
  problem.cols = evidence.frame.cols;
  const size_t num_cells = problem.Index(problem.rows, 0);
  problem.source_capacity.assign(num_cells, 0);
  problem.sink_capacity.assign(num_cells, 0);
  if (evidence.mode == EvidenceMode::kCounts) {
    AddCounts(evidence, options, problem);
  } else {
    AddLogOdds(evidence, options, problem);
  }
  ForceBorderOutside(problem);
  // Of one region, twice as wide cells have a quarter of the evidence and half of the sides.
  const int32_t side =
      ToCapacity(options.lambda * options.reference_cell_m / evidence.frame.cell_m);
  problem.east_capacity.assign(num_cells, side);
  problem.north_capacity.assign(num_cells, side);
  return problem;
}

}  // namespace enfilade
