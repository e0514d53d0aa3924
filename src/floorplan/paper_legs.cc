// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_legs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "src/floorplan/grid_steps.h"

namespace enfilade {
namespace {

constexpr double kMargin_m = 1;
constexpr int64_t kNoWay = 1 << 28;

}  // namespace

LegSolver::LegSolver(const PaperField& field, const ImageU8& core, const ImageU8& foreign)
    : field_(field), problem_(MakePaperProblem(field, core, foreign, 0)) {}

int64_t LegSolver::Cost(const GridPass& from, const GridPass& to) const {
  const int margin = static_cast<int>(std::lround(kMargin_m / field_.frame.cell_m));
  const auto [low_row, high_row] = std::minmax(from.vertex.row, to.vertex.row);
  const auto [low_col, high_col] = std::minmax(from.vertex.col, to.vertex.col);
  const GridVertex low{std::max(0, low_row - margin), std::max(0, low_col - margin)};
  const GridVertex high{std::min(problem_.rows, high_row + margin),
                        std::min(problem_.cols, high_col + margin)};
  const int cols = high.col - low.col + 1;
  const auto state_of = [&](const GridVertex& v, GridHeading heading) {
    return ((v.row - low.row) * cols + v.col - low.col) * 4 + static_cast<int>(heading);
  };
  const int num_states = (high.row - low.row + 1) * cols * 4;
  std::vector<int> cost(static_cast<size_t>(num_states), std::numeric_limits<int>::max());
  using Item = std::pair<int, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  const auto push = [&](int state, int value) {
    if (value >= cost[static_cast<size_t>(state)]) return;
    cost[static_cast<size_t>(state)] = value;
    queue.emplace(value, state);
  };
  // A state is the vertex and the heading in which it is left.
  push(state_of(from.vertex, from.heading), 0);
  const int goal = state_of(to.vertex, to.heading);
  while (!queue.empty()) {
    const auto [value, state] = queue.top();
    queue.pop();
    if (state == goal) return value;
    if (value > cost[static_cast<size_t>(state)]) continue;
    const auto heading = static_cast<GridHeading>(state & 3);
    const GridVertex at{low.row + state / 4 / cols, low.col + state / 4 % cols};
    const GridVertex next = Moved(at, heading);
    if (next.row < low.row || next.col < low.col || next.row > high.row || next.col > high.col)
      continue;
    const uint16_t step = problem_.step_cost[problem_.StepIndex(at.row, at.col, heading)];
    const GridVertex right = RightCell(at, heading);
    const bool is_core = right.row >= 0 && right.col >= 0 && right.row < problem_.rows &&
                         right.col < problem_.cols &&
                         problem_.core[static_cast<size_t>(right.row * problem_.cols + right.col)];
    if (step == kBlockedStep || is_core) continue;
    push(state_of(next, heading), value + step);
    push(state_of(next, TurnedLeft(heading)), value + step + problem_.turn_cost);
    push(state_of(next, TurnedRight(heading)), value + step + problem_.turn_cost);
  }
  return kNoWay;
}

}  // namespace enfilade
