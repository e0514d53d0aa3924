// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/optim/loop_box.h"

#include <algorithm>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

bool IsCore(const GridLoopProblem& problem, int row, int col) {
  return row >= 0 && col >= 0 && row < problem.rows && col < problem.cols &&
         problem.core[static_cast<size_t>(row) * static_cast<size_t>(problem.cols) +
                      static_cast<size_t>(col)] != 0;
}

size_t CountCore(const GridLoopProblem& problem) {
  return static_cast<size_t>(std::count_if(problem.core.begin(), problem.core.end(),
                                           [](uint8_t cell) { return cell != 0; }));
}

// Number of core cells that share sides with the first one, directly or through others.
size_t CountConnectedCore(const GridLoopProblem& problem) {
  const auto first = std::find_if(problem.core.begin(), problem.core.end(),
                                  [](uint8_t cell) { return cell != 0; });
  std::vector<uint8_t> is_new = problem.core;
  std::vector<int> stack{static_cast<int>(first - problem.core.begin())};
  is_new[static_cast<size_t>(stack.front())] = 0;
  size_t count = 0;
  const auto visit = [&](int cell) {
    if (is_new[static_cast<size_t>(cell)] == 0) return;
    is_new[static_cast<size_t>(cell)] = 0;
    stack.push_back(cell);
  };
  while (!stack.empty()) {
    const int cell = stack.back();
    stack.pop_back();
    ++count;
    const int row = cell / problem.cols, col = cell % problem.cols;
    if (row > 0) visit(cell - problem.cols);
    if (row + 1 < problem.rows) visit(cell + problem.cols);
    if (col > 0) visit(cell - 1);
    if (col + 1 < problem.cols) visit(cell + 1);
  }
  return count;
}

}  // namespace

GridLoopOutcome CheckCore(const GridLoopProblem& problem) {
  const size_t num_cells = static_cast<size_t>(problem.rows) * static_cast<size_t>(problem.cols);
  ENFILADE_CHECK(problem.rows >= 0 && problem.cols >= 0 && problem.core.size() == num_cells);
  ENFILADE_CHECK(problem.step_cost.size() ==
                 problem.StepIndex(problem.rows + 1, 0, GridHeading::kEast));
  const size_t num_core = CountCore(problem);
  if (num_core == 0) return GridLoopOutcome::kEmptyCore;
  const bool is_connected = CountConnectedCore(problem) == num_core;
  return is_connected ? GridLoopOutcome::kFound : GridLoopOutcome::kDisconnectedCore;
}

LoopBox::LoopBox(const GridLoopProblem& problem) {
  ChooseBox(problem);
  CopySteps(problem);
  for (const uint16_t cost : step_) {
    if (cost != kBlockedStep) max_step_ = std::max(max_step_, cost);
  }
}

int LoopBox::VertexOf(GridVertex at) const {
  const int row = at.row - low_row_ + 1, col = at.col - low_col_ + 1;
  const bool is_inside = row > 0 && col > 0 && row + 1 < rows_ && col + 1 < cols_;
  return is_inside ? row * cols_ + col : -1;
}

// The box of the core grown by the margin, and the ray from the core's easternmost cell: beyond
// that column there is no core, so the ray meets it nowhere else.
void LoopBox::ChooseBox(const GridLoopProblem& problem) {
  int first_row = problem.rows, last_row = -1, first_col = problem.cols, last_col = -1,
      ray_row = -1;
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      if (!IsCore(problem, row, col)) continue;
      first_row = std::min(first_row, row);
      last_row = row;
      first_col = std::min(first_col, col);
      if (col > last_col) {
        last_col = col;
        ray_row = row;
      }
    }
  }
  ENFILADE_CHECK(last_row >= 0);
  const int margin = std::max(problem.margin_cells, 0);
  low_row_ = std::max(first_row - margin, 0);
  low_col_ = std::max(first_col - margin, 0);
  const int high_row =
      static_cast<int>(std::min<int64_t>(int64_t{last_row} + 1 + margin, problem.rows));
  const int high_col =
      static_cast<int>(std::min<int64_t>(int64_t{last_col} + 1 + margin, problem.cols));
  rows_ = high_row - low_row_ + 3;  // vertices low … high and the frame
  cols_ = high_col - low_col_ + 3;
  offset_[0] = 1;
  offset_[1] = cols_;
  offset_[2] = -1;
  offset_[3] = -cols_;
  seam_bottom_ = (ray_row - low_row_ + 1) * cols_ + (last_col + 1 - low_col_ + 1);
  seam_top_ = seam_bottom_ + cols_;
  num_seams_ = high_col - last_col;
}

// Steps of the box; those out of it, through the core, or with the core on their right are blocked.
void LoopBox::CopySteps(const GridLoopProblem& problem) {
  step_.assign(static_cast<size_t>(num_vertices()) * 4, kBlockedStep);
  for (int row = 1; row + 1 < rows_; ++row) {
    for (int col = 1; col + 1 < cols_; ++col) {
      const int r = low_row_ + row - 1,
                c = low_col_ + col - 1;  // of the vertex in the problem's grid
      const bool is_room[4] = {col + 2 < cols_, row + 2 < rows_, col > 1, row > 1};
      const bool is_core_on_right[4] = {IsCore(problem, r - 1, c), IsCore(problem, r, c),
                                        IsCore(problem, r, c - 1), IsCore(problem, r - 1, c - 1)};
      for (int heading = 0; heading < 4; ++heading) {
        if (!is_room[heading] || is_core_on_right[heading]) continue;
        step_[static_cast<size_t>(row * cols_ + col) * 4 + static_cast<size_t>(heading)] =
            problem.step_cost[problem.StepIndex(r, c, static_cast<GridHeading>(heading))];
      }
    }
  }
}

}  // namespace enfilade
