// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/cells.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

template <typename Visit>
void VisitNeighbors(int cell, int rows, int cols, Visit&& visit) {
  const int row = cell / cols, col = cell % cols;
  if (row > 0) visit(cell - cols);
  if (col > 0) visit(cell - 1);
  if (col + 1 < cols) visit(cell + 1);
  if (row + 1 < rows) visit(cell + cols);
}

}  // namespace

Ring2 RingInMetres(const GridFrame& frame, const std::vector<GridVertex>& ring) {
  Ring2 result;
  for (const GridVertex& vertex : ring) {
    result.push_back(frame.origin + frame.cell_m * Eigen::Vector2d(vertex.col, vertex.row));
  }
  return result;
}

ImageU8 CellsInside(int rows, int cols, const std::vector<GridVertex>& ring) {
  ImageU8 inside(rows, cols);
  // Vertical edges flip everything to their east.
  for (size_t i = 0; i < ring.size(); ++i) {
    const GridVertex& a = ring[i];
    const GridVertex& b = ring[(i + 1) % ring.size()];
    if (a.col != b.col || a.col >= cols) continue;
    for (int row = std::min(a.row, b.row); row < std::max(a.row, b.row); ++row)
      inside(row, a.col) ^= 1;
  }
  for (int row = 0; row < rows; ++row) {
    for (int col = 1; col < cols; ++col) inside(row, col) ^= inside(row, col - 1);
  }
  return inside;
}

std::vector<CellSet> ConnectedCells(const ImageU8& cells) {
  ImageU8 is_new = cells;
  std::vector<CellSet> sets;
  std::vector<int> stack;
  for (int first = 0; first < static_cast<int>(cells.data().size()); ++first) {
    if (is_new.data()[static_cast<size_t>(first)] == 0) continue;
    CellSet set;
    const auto take = [&](int cell) {
      uint8_t& flag = is_new.data()[static_cast<size_t>(cell)];
      if (flag != 0) stack.push_back(cell);
      flag = 0;
    };
    take(first);
    while (!stack.empty()) {
      const int cell = stack.back();
      stack.pop_back();
      set.push_back(cell);
      VisitNeighbors(cell, cells.rows(), cells.cols(), take);
    }
    std::sort(set.begin(), set.end());
    sets.push_back(std::move(set));
  }
  return sets;
}

CellWays FindCellWays(const ImageF& cell_cost, const ImageI& source) {
  const int rows = cell_cost.rows(), cols = cell_cost.cols();
  ENFILADE_CHECK(source.rows() == rows && source.cols() == cols);
  CellWays ways{ImageF(rows, cols, 1, std::numeric_limits<float>::infinity()),
                ImageI(rows, cols, 1, -1), ImageI(rows, cols, 1, -1)};
  using Item = std::pair<float, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (size_t i = 0; i < source.data().size(); ++i) {
    if (source.data()[i] < 0) continue;
    ways.cost.data()[i] = 0;
    ways.source.data()[i] = source.data()[i];
    queue.emplace(0.0F, static_cast<int>(i));
  }
  while (!queue.empty()) {
    const auto [cost, cell] = queue.top();
    queue.pop();
    if (cost > ways.cost.data()[static_cast<size_t>(cell)]) continue;
    VisitNeighbors(cell, rows, cols, [&, cost = cost, cell = cell](int next) {
      const auto i = static_cast<size_t>(next);
      const float step = cell_cost.data()[i];
      if (step < 0 || cost + step >= ways.cost.data()[i]) return;
      ways.cost.data()[i] = cost + step;
      ways.source.data()[i] = ways.source.data()[static_cast<size_t>(cell)];
      ways.parent.data()[i] = cell;
      queue.emplace(cost + step, next);
    });
  }
  return ways;
}

}  // namespace enfilade
