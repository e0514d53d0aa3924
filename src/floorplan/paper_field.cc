// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_field.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {
namespace {

ImageF WholeNumbers(const ImageF& counts) {
  ImageF clean = counts;
  for (float& count : clean.data()) {
    if (!std::isfinite(count) || count < 0) count = 0;
  }
  return clean;
}

// A step is paid for where the wall is seen in neither cell beside it.
std::vector<uint16_t> StepCosts(const PaperField& field) {
  const int rows = field.frame.rows, cols = field.frame.cols;
  const auto is_seen = [&](int row, int col) {
    return field.frame.IsInside(row, col) && field.IsSeen(row, col);
  };
  GridLoopProblem layout;
  layout.rows = rows;
  layout.cols = cols;
  std::vector<uint16_t> costs(layout.StepIndex(rows + 1, 0, GridHeading::kEast));
  for (int row = 0; row <= rows; ++row) {
    for (int col = 0; col <= cols; ++col) {
      const bool ne = is_seen(row, col), nw = is_seen(row, col - 1);
      const bool se = is_seen(row - 1, col), sw = is_seen(row - 1, col - 1);
      const auto set = [&](GridHeading heading, bool is_wall) {
        costs[layout.StepIndex(row, col, heading)] = is_wall ? 0 : kCostPerCell;
      };
      set(GridHeading::kEast, ne || se);
      set(GridHeading::kNorth, ne || nw);
      set(GridHeading::kWest, nw || sw);
      set(GridHeading::kSouth, se || sw);
    }
  }
  return costs;
}

}  // namespace

PaperField MakePaperField(const EvidenceGrids& evidence, const PaperOptions& options) {
  ENFILADE_CHECK(evidence.mode == EvidenceMode::kCounts);
  PaperField field;
  field.frame = evidence.frame;
  field.wall = WholeNumbers(evidence.wall);
  field.rays = WholeNumbers(evidence.free);
  field.is_sure = ImageU8(field.frame.rows, field.frame.cols, 1, 1);
  for (size_t i = 0; i < evidence.support.data().size(); ++i)
    field.is_sure.data()[i] = (evidence.support.data()[i] & kStrongSupport) != 0;
  field.seen_points =
      std::max(1.0F, static_cast<float>(options.wall_points_per_m * field.frame.cell_m));
  field.turn_cost = std::max(
      1, static_cast<int>(std::lround(options.alpha_m / field.frame.cell_m * kCostPerCell)));
  field.step_cost = StepCosts(field);
  return field;
}

GridLoopProblem MakePaperProblem(const PaperField& field, const ImageU8& core,
                                 const ImageU8& foreign, double margin_m) {
  GridLoopProblem problem;
  problem.rows = field.frame.rows;
  problem.cols = field.frame.cols;
  problem.core = core.data();
  problem.step_cost = field.step_cost;
  problem.turn_cost = field.turn_cost;
  problem.margin_cells = static_cast<int>(std::lround(margin_m / field.frame.cell_m));
  BlockCells(foreign, problem);
  return problem;
}

}  // namespace enfilade
