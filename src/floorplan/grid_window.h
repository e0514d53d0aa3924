// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "enfilade/image/image.h"

namespace enfilade {

/// A part of a grid: cell (r, c) of the window is cell (row + r, col + c) of the grid.
struct GridWindow {
  int row = 0, col = 0;
  int rows = 0, cols = 0;

  /// The window with the cell, which comes in row-major order; the first one into an empty window.
  void Add(int cell_row, int cell_col) {
    if (rows == 0) {
      *this = {cell_row, cell_col, 1, 1};
      return;
    }
    const int end_col = std::max(col + cols, cell_col + 1);
    rows = cell_row + 1 - row;
    col = std::min(col, cell_col);
    cols = end_col - col;
  }

  /// The window grown by so many cells on each side, as far as the grid goes.
  [[nodiscard]] GridWindow Grown(int margin, int grid_rows, int grid_cols) const {
    GridWindow grown;
    grown.row = std::max(row - margin, 0);
    grown.col = std::max(col - margin, 0);
    grown.rows = std::min(row + rows + margin, grid_rows) - grown.row;
    grown.cols = std::min(col + cols + margin, grid_cols) - grown.col;
    return grown;
  }
};

/// The window's part of an image with one channel.
template <typename T>
[[nodiscard]] Image<T> Cropped(const Image<T>& image, const GridWindow& window) {
  Image<T> part(window.rows, window.cols);
  for (int r = 0; r < window.rows; ++r)
    std::copy_n(image.row(window.row + r) + window.col, window.cols, part.row(r));
  return part;
}

/// 1 where the cell's value satisfies the condition.
template <typename T, typename Condition>
[[nodiscard]] ImageU8 CellsWhere(const Image<T>& image, const Condition& condition) {
  ImageU8 cells(image.rows(), image.cols());
  for (size_t i = 0; i < cells.data().size(); ++i) cells.data()[i] = condition(image.data()[i]);
  return cells;
}

}  // namespace enfilade
