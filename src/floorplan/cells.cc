// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/cells.h"

#include <algorithm>
#include <bit>
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

template <typename T>
std::vector<CellSet> ConnectedCells(const Image<T>& cells) {
  Image<T> is_new = cells;
  std::vector<CellSet> sets;
  std::vector<int> stack;
  for (int first = 0; first < static_cast<int>(cells.data().size()); ++first) {
    const T value = is_new.data()[static_cast<size_t>(first)];
    if (value == 0) continue;
    CellSet set;
    const auto take = [&](int cell) {
      T& left = is_new.data()[static_cast<size_t>(cell)];
      if (left != value) return;
      stack.push_back(cell);
      left = 0;
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

template std::vector<CellSet> ConnectedCells(const Image<uint8_t>&);
template std::vector<CellSet> ConnectedCells(const Image<uint16_t>&);

CellWays FindCellWays(const ImageF& cell_cost, ImageI source) {
  const int rows = cell_cost.rows(), cols = cell_cost.cols();
  ENFILADE_CHECK(source.rows() == rows && source.cols() == cols);
  CellWays ways{ImageF(rows, cols, 1, std::numeric_limits<float>::infinity()), std::move(source),
                ImageI(rows, cols, 1, -1)};
  // Costs are not negative, so their bits have their order: by cost, then by cell.
  const auto item = [](float cost, int cell) {
    return uint64_t{std::bit_cast<uint32_t>(cost)} << 32 | static_cast<uint32_t>(cell);
  };
  std::priority_queue<uint64_t, std::vector<uint64_t>, std::greater<>> queue;
  for (size_t i = 0; i < ways.source.data().size(); ++i) {
    if (ways.source.data()[i] < 0) continue;
    ways.cost.data()[i] = 0;
    queue.push(item(0, static_cast<int>(i)));
  }
  while (!queue.empty()) {
    const float cost = std::bit_cast<float>(static_cast<uint32_t>(queue.top() >> 32));
    const int cell = static_cast<int>(static_cast<uint32_t>(queue.top()));
    queue.pop();
    if (cost > ways.cost.data()[static_cast<size_t>(cell)]) continue;
    VisitNeighbors(cell, rows, cols, [&](int next) {
      const auto i = static_cast<size_t>(next);
      const float step = cell_cost.data()[i];
      if (step < 0 || cost + step >= ways.cost.data()[i]) return;
      ways.cost.data()[i] = cost + step;
      ways.source.data()[i] = ways.source.data()[static_cast<size_t>(cell)];
      ways.parent.data()[i] = cell;
      queue.push(item(cost + step, next));
    });
  }
  return ways;
}

}  // namespace enfilade
