// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/cell_outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

constexpr int kRowStep[4] = {0, 1, 0, -1};
constexpr int kColStep[4] = {1, 0, -1, 0};
constexpr uint8_t kNoStep = 0xFF;

// For each vertex of the grid the heading in which the border leaves it, the set on the left.
class Border {
 public:
  Border(int rows, int cols, const CellSet& set) : heading_(rows + 1, cols + 1, 1, kNoStep) {
    ImageU8 inside(rows, cols);
    for (const int cell : set) inside.data()[static_cast<size_t>(cell)] = 1;
    const auto is_inside = [&](int row, int col) {
      return row >= 0 && col >= 0 && row < rows && col < cols && inside(row, col) != 0;
    };
    for (const int cell : set) {
      const int row = cell / cols, col = cell % cols;
      if (!is_inside(row - 1, col)) Leave(row, col, GridHeading::kEast);
      if (!is_inside(row, col + 1)) Leave(row, col + 1, GridHeading::kNorth);
      if (!is_inside(row + 1, col)) Leave(row + 1, col + 1, GridHeading::kWest);
      if (!is_inside(row, col - 1)) Leave(row + 1, col, GridHeading::kSouth);
    }
  }

  // All rings, each from its lowest vertex in the west: the first one is the outer one.
  [[nodiscard]] std::vector<std::vector<GridVertex>> TakeRings() {
    std::vector<std::vector<GridVertex>> rings;
    for (int row = 0; row < heading_.rows(); ++row) {
      for (int col = 0; col < heading_.cols(); ++col) {
        if (heading_(row, col) != kNoStep) rings.push_back(TakeRing({row, col}));
      }
    }
    return rings;
  }

 private:
  void Leave(int row, int col, GridHeading heading) {
    ENFILADE_CHECK(heading_(row, col) == kNoStep);  // cells that touch at a corner alone
    heading_(row, col) = static_cast<uint8_t>(heading);
  }

  std::vector<GridVertex> TakeRing(GridVertex vertex) {
    std::vector<GridVertex> ring;
    uint8_t last = kNoStep;
    while (heading_(vertex.row, vertex.col) != kNoStep) {
      const uint8_t heading = std::exchange(heading_(vertex.row, vertex.col), kNoStep);
      if (heading != last) ring.push_back(vertex);
      last = heading;
      vertex = {vertex.row + kRowStep[heading], vertex.col + kColStep[heading]};
    }
    return ring;
  }

  ImageU8 heading_;
};

// Joins what touches at the corner of four cells, the first one the lowest in the west.
bool JoinCorner(int row, int col, ImageU8& cells) {
  const bool low_west = cells(row, col) != 0, low_east = cells(row, col + 1) != 0;
  const bool high_west = cells(row + 1, col) != 0, high_east = cells(row + 1, col + 1) != 0;
  if (low_west != high_east || low_east != high_west || low_west == low_east) return false;
  (low_west ? cells(row, col + 1) : cells(row, col)) = 1;
  return true;
}

}  // namespace

size_t CellsOf(double area_m2, double cell_m) {
  return static_cast<size_t>(std::ceil(area_m2 / (cell_m * cell_m)));
}

void JoinCorners(ImageU8& cells) {
  // A cell that is set may touch another one at a corner that was passed already.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (int row = 0; row + 1 < cells.rows(); ++row) {
      for (int col = 0; col + 1 < cells.cols(); ++col) has_changed |= JoinCorner(row, col, cells);
    }
  }
}

void FillSmallHoles(size_t min_cells, ImageU8& cells) {
  ImageU8 outside = cells;
  for (uint8_t& cell : outside.data()) cell = cell == 0;
  for (const CellSet& hole : ConnectedCells(outside)) {
    const bool is_open = std::any_of(hole.begin(), hole.end(), [&](int cell) {
      const int row = cell / cells.cols(), col = cell % cells.cols();
      return row == 0 || col == 0 || row + 1 == cells.rows() || col + 1 == cells.cols();
    });
    if (is_open || hole.size() >= min_cells) continue;
    for (const int cell : hole) cells.data()[static_cast<size_t>(cell)] = 1;
  }
}

CellOutline TraceOutline(int rows, int cols, const CellSet& set) {
  std::vector<std::vector<GridVertex>> rings = Border(rows, cols, set).TakeRings();
  CellOutline outline;
  if (rings.empty()) return outline;
  outline.outer = std::move(rings.front());
  rings.erase(rings.begin());
  outline.holes = std::move(rings);
  return outline;
}

}  // namespace enfilade
