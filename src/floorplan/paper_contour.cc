// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_contour.h"

#include <algorithm>

#include "enfilade/base/check.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/image/distance_transform.h"
#include "src/floorplan/grid_steps.h"

namespace enfilade {
namespace {

constexpr double kClosing_m = 0.05;
constexpr double kOpening_m = 0.08;

ImageU8 Inverted(const ImageU8& mask) {
  ImageU8 inverted = mask;
  for (uint8_t& cell : inverted.data()) cell = cell == 0;
  return inverted;
}

// Also the cells that no way over cell sides leads to from the border.
ImageU8 WithoutHoles(const ImageU8& region) {
  ImageU8 filled(region.rows(), region.cols(), 1, 1);
  for (const CellSet& set : ConnectedCells(Inverted(region))) {
    const bool is_outside = std::any_of(set.begin(), set.end(), [&](int cell) {
      const int row = cell / region.cols(), col = cell % region.cols();
      return row == 0 || col == 0 || row + 1 == region.rows() || col + 1 == region.cols();
    });
    if (!is_outside) continue;
    for (const int cell : set) filled.data()[static_cast<size_t>(cell)] = 0;
  }
  return filled;
}

}  // namespace

ImageU8 ClosedFreeSpace(const PaperField& field, const ImageU8& core, const ImageU8& foreign) {
  const int rows = field.frame.rows, cols = field.frame.cols;
  const double closing_px = kClosing_m / field.frame.cell_m;
  ImageU8 free(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) free(row, col) = field.IsFree(row, col);
  }
  free = Inverted(DilateByDisc(Inverted(DilateByDisc(free, closing_px)), closing_px));
  free = OpenByDisc(free, kOpening_m / field.frame.cell_m);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const bool is_border = row == 0 || col == 0 || row + 1 == rows || col + 1 == cols;
      if (is_border || foreign(row, col) != 0) free(row, col) = 0;
      if (core(row, col) != 0) free(row, col) = 1;
    }
  }
  for (const CellSet& set : ConnectedCells(free)) {
    const bool has_core = std::any_of(set.begin(), set.end(), [&](int cell) {
      return core.data()[static_cast<size_t>(cell)] != 0;
    });
    if (has_core) continue;
    for (const int cell : set) free.data()[static_cast<size_t>(cell)] = 0;
  }
  return WithoutHoles(free);
}

std::vector<GridVertex> TraceContour(const ImageU8& region) {
  const auto first = std::find_if(region.data().begin(), region.data().end(),
                                  [](uint8_t cell) { return cell != 0; });
  if (first == region.data().end()) return {};
  const auto index = static_cast<int>(first - region.data().begin());
  const auto is_inside = [&](const GridVertex& cell) {
    return cell.row >= 0 && cell.col >= 0 && cell.row < region.rows() && cell.col < region.cols() &&
           region(cell.row, cell.col) != 0;
  };
  // The lowest cell's lower side is on the contour, with the region on the left of a step east.
  const GridVertex start{index / region.cols(), index % region.cols()};
  std::vector<GridVertex> contour;
  GridVertex at = start;
  GridHeading heading = GridHeading::kEast;
  do {
    contour.push_back(at);
    at = Moved(at, heading);
    // Where two cells meet at a corner only, the contour stays with its own.
    if (!is_inside(LeftCell(at, heading))) {
      heading = TurnedLeft(heading);
    } else if (is_inside(RightCell(at, heading))) {
      heading = TurnedRight(heading);
    }
    ENFILADE_CHECK(contour.size() <= 4 * region.data().size());
  } while (!(at == start && heading == GridHeading::kEast));
  return contour;
}

}  // namespace enfilade
