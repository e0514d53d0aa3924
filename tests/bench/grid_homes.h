// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "tests/optim/grid_problems.h"

namespace enfilade {

/// Random dear steps all over, round a core that is the middle quarter of both sides.
inline GridLoopProblem MakeNoise(int rows, int cols) {
  GridLoopProblem problem = MakeProblem(rows, cols, 0, 250);
  for (int row = rows * 3 / 8; row < rows * 5 / 8; ++row) {
    for (int col = cols * 3 / 8; col < cols * 5 / 8; ++col) {
      problem.core[static_cast<size_t>(row * cols + col)] = 1;
    }
  }
  std::mt19937 random(7);
  for (uint16_t& cost : problem.step_cost) cost = static_cast<uint16_t>(5 + random() % 21);
  return problem;
}

/// A jagged outline of six walls a side: 44 corners, or a few less.
inline std::vector<GridVertex> MakeOutline(int rows, int cols, unsigned seed) {
  constexpr int kNumWalls = 6;
  std::mt19937 random(seed);
  std::array<std::array<int, kNumWalls>, 4> place;  // of each wall across its side: S, E, N, W
  for (size_t side = 0; side < 4; ++side) {
    const int size = side % 2 == 0 ? rows : cols;
    for (int& value : place[side]) {
      const int depth = size / 8 + static_cast<int>(random() % static_cast<unsigned>(size / 10));
      value = side == 0 || side == 3 ? depth : size - depth;
    }
  }
  std::vector<GridVertex> ring;
  for (size_t side = 0; side < 4; ++side) {
    const int from = place[(side + 3) % 4].back(), to = place[(side + 1) % 4].front();
    for (int i = 0; i <= kNumWalls; ++i) {
      const int along = from + (to - from) * i / kNumWalls;
      for (const int wall : {i - 1, i}) {
        if (wall < 0 || wall == kNumWalls) continue;
        const int across = place[side][static_cast<size_t>(wall)];
        ring.push_back(side % 2 == 0 ? GridVertex{across, along} : GridVertex{along, across});
      }
    }
  }
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

/// Noise with cheap walls along an outline; the core is the inside, ten cells from the walls.
inline GridLoopProblem MakeWalls(int rows, int cols, const std::vector<GridVertex>& outline) {
  constexpr int kMargin = 10;
  GridLoopProblem problem = MakeNoise(rows, cols);
  for (size_t i = 0; i < outline.size(); ++i) {
    SetEdge(problem, outline[i], outline[(i + 1) % outline.size()], 1);
  }
  const auto is_near_or_out = [&](int row, int col) {
    bool is_inside = false;
    for (size_t i = 0; i < outline.size(); ++i) {
      const GridVertex a = outline[i], b = outline[(i + 1) % outline.size()];
      const int low_row = std::min(a.row, b.row), high_row = std::max(a.row, b.row);
      const int low_col = std::min(a.col, b.col), high_col = std::max(a.col, b.col);
      if (row >= low_row - kMargin && row < high_row + kMargin && col >= low_col - kMargin &&
          col < high_col + kMargin) {
        return true;
      }
      if (a.col == b.col && a.col > col && row >= low_row && row < high_row) is_inside = !is_inside;
    }
    return !is_inside;
  };
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      problem.core[static_cast<size_t>(row * cols + col)] = !is_near_or_out(row, col);
    }
  }
  return problem;
}

}  // namespace enfilade
