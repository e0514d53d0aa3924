// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/ray_traversal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace enfilade {
namespace {

using Cells = std::vector<std::pair<int, int>>;

GridFrame SmallFrame() {
  GridFrame frame;
  frame.origin = {-1, 2};
  frame.cell_m = 0.5;
  frame.rows = 8;
  frame.cols = 10;
  return frame;
}

Cells Traverse(const GridFrame& frame, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Cells cells;
  TraverseCells(frame, a, b, [&](int row, int col) {
    cells.emplace_back(row, col);
    return true;
  });
  return cells;
}

// Brute force: the slab test of the segment against every cell, in the order of entry.
Cells CrossedCells(const GridFrame& frame, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  std::vector<std::pair<double, std::pair<int, int>>> entries;
  for (int row = 0; row < frame.rows; ++row) {
    for (int col = 0; col < frame.cols; ++col) {
      const Eigen::Vector2d low = frame.origin + frame.cell_m * Eigen::Vector2d(col, row);
      double enter = 0, leave = 1;
      for (int k = 0; k < 2; ++k) {
        const double t0 = (low[k] - a[k]) / (b[k] - a[k]);
        const double t1 = (low[k] + frame.cell_m - a[k]) / (b[k] - a[k]);
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
      }
      if (enter < leave) entries.push_back({enter, {row, col}});
    }
  }
  std::sort(entries.begin(), entries.end());
  Cells cells;
  for (const auto& [enter, cell] : entries) cells.push_back(cell);
  return cells;
}

TEST(TraverseCells, EqualsBruteForceOnRandomSegments) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-3, 6), y(0, 8);
  const GridFrame frame = SmallFrame();
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d a(x(random), y(random)), b(x(random), y(random));
    EXPECT_EQ(Traverse(frame, a, b), CrossedCells(frame, a, b))
        << a.transpose() << " " << b.transpose();
  }
}

TEST(TraverseCells, AxisAlignedAndPointSegments) {
  const GridFrame frame = SmallFrame();
  EXPECT_THAT(Traverse(frame, {-0.9, 2.1}, {0.4, 2.1}),
              testing::ElementsAre(std::pair(0, 0), std::pair(0, 1), std::pair(0, 2)));
  EXPECT_THAT(Traverse(frame, {0.1, 3.2}, {0.1, 2.1}),
              testing::ElementsAre(std::pair(2, 2), std::pair(1, 2), std::pair(0, 2)));
  EXPECT_THAT(Traverse(frame, {0.1, 2.2}, {0.1, 2.2}), testing::ElementsAre(std::pair(0, 2)));
  EXPECT_THAT(Traverse(frame, {-9, -9}, {-8, -9}), testing::IsEmpty());
}

TEST(TraverseCells, StopsWhenTold) {
  int visited = 0;
  TraverseCells(SmallFrame(), {-0.9, 2.1}, {3.9, 5.9}, [&](int, int) { return ++visited < 3; });
  EXPECT_EQ(visited, 3);
}

TEST(TraverseCells, EndsInTheCellOfTheEndThroughCorners) {
  const Cells cells = Traverse(SmallFrame(), {-1, 2}, {1, 4});
  EXPECT_EQ(cells.front(), std::pair(0, 0));
  EXPECT_EQ(cells.back(), std::pair(4, 4));
  EXPECT_EQ(cells.size(), 9u);  // a corner adds the cell beside it
}

}  // namespace
}  // namespace enfilade
