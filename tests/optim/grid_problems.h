// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "enfilade/optim/grid_loop.h"

namespace enfilade {

inline GridLoopProblem MakeProblem(int rows, int cols, uint16_t step_cost, int turn_cost) {
  GridLoopProblem problem;
  problem.rows = rows;
  problem.cols = cols;
  problem.turn_cost = turn_cost;
  problem.core.assign(static_cast<size_t>(rows * cols), 0);
  problem.step_cost.assign(problem.StepIndex(rows + 1, 0, GridHeading::kEast), step_cost);
  return problem;
}

// Rows of text, the top one is the highest row: '#' core, other characters none.
inline GridLoopProblem ParseCore(const std::vector<std::string>& text, uint16_t step_cost,
                                 int turn_cost) {
  GridLoopProblem problem = MakeProblem(static_cast<int>(text.size()),
                                        static_cast<int>(text[0].size()), step_cost, turn_cost);
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      const char c = text[static_cast<size_t>(problem.rows - 1 - row)][static_cast<size_t>(col)];
      problem.core[static_cast<size_t>(row * problem.cols + col)] = c == '#';
    }
  }
  return problem;
}

inline void SetEdge(GridLoopProblem& problem, GridVertex a, GridVertex b, uint16_t cost) {
  const int dr = (b.row > a.row) - (b.row < a.row), dc = (b.col > a.col) - (b.col < a.col);
  const auto heading = dc > 0   ? GridHeading::kEast
                       : dr > 0 ? GridHeading::kNorth
                       : dc < 0 ? GridHeading::kWest
                                : GridHeading::kSouth;
  for (; !(a == b); a = {a.row + dr, a.col + dc}) {
    problem.step_cost[problem.StepIndex(a.row, a.col, heading)] = cost;
  }
}

inline constexpr int kRowStep[4] = {0, 1, 0, -1};
inline constexpr int kColStep[4] = {1, 0, -1, 0};

inline bool IsCore(const GridLoopProblem& p, int row, int col) {
  return row >= 0 && col >= 0 && row < p.rows && col < p.cols &&
         p.core[static_cast<size_t>(row * p.cols + col)] != 0;
}

// A random connected core: a random walk of cells.
inline void AddRandomCore(GridLoopProblem& p, int num_cells, std::mt19937& random) {
  int row = static_cast<int>(random() % static_cast<unsigned>(p.rows));
  int col = static_cast<int>(random() % static_cast<unsigned>(p.cols));
  for (int i = 0; i < num_cells; ++i) {
    p.core[static_cast<size_t>(row * p.cols + col)] = 1;
    const unsigned heading = random() % 4;
    row = std::clamp(row + kRowStep[heading], 0, p.rows - 1);
    col = std::clamp(col + kColStep[heading], 0, p.cols - 1);
    if (random() % 2 != 0) continue;
    p.core[static_cast<size_t>(row * p.cols + col)] = 1;
  }
}

// Random steps of random size, some of them blocked, round a random core; sides of 3 to
// max_size + 2 cells.
inline GridLoopProblem MakeRandomProblem(unsigned max_size, std::mt19937& random) {
  GridLoopProblem problem = MakeProblem(3 + static_cast<int>(random() % max_size),
                                        3 + static_cast<int>(random() % max_size), 0,
                                        1 + static_cast<int>(random() % 12));
  const unsigned max_cost = 1 + random() % 20;
  const bool has_blocked = random() % 3 == 0;
  for (uint16_t& cost : problem.step_cost) {
    cost = static_cast<uint16_t>(random() % max_cost);
    if (has_blocked && random() % 6 == 0) cost = kBlockedStep;
  }
  AddRandomCore(problem, 1 + static_cast<int>(random() % 12), random);
  return problem;
}

// A random rectilinear walk as a free corridor on dear ground: cheap routes fold back over the ray.
inline GridLoopProblem MakeFoldedProblem(int size, int num_runs, std::mt19937& random) {
  GridLoopProblem problem = MakeProblem(size, size, 60, 1);
  const unsigned num_vertices = static_cast<unsigned>(size + 1);
  problem.core[static_cast<size_t>(4 * size) + 2 + random() % 3] = 1;
  GridVertex at{static_cast<int>(random() % num_vertices),
                static_cast<int>(random() % num_vertices)};
  for (int k = 0; k < num_runs; ++k) {
    GridVertex next = at;
    (k % 2 != 0 ? next.row : next.col) = static_cast<int>(random() % num_vertices);
    SetEdge(problem, at, next, 0);
    at = next;
  }
  return problem;
}

}  // namespace enfilade
