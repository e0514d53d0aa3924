// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "enfilade/image/image.h"

namespace enfilade {

/// Where the cells of a grid lie in the plan of the home frame: the centre of cell (row, col) is
/// origin + (col + ½, row + ½)·cell_m; rows grow with y.
struct GridFrame {
  Eigen::Vector2d origin{0, 0};
  double cell_m = 0.025;
  int rows = 0;
  int cols = 0;

  [[nodiscard]] Eigen::Vector2d Center(int row, int col) const {
    return origin + cell_m * Eigen::Vector2d(col + 0.5, row + 0.5);
  }
  [[nodiscard]] int Row(double y) const {
    return static_cast<int>(std::floor((y - origin.y()) / cell_m));
  }
  [[nodiscard]] int Col(double x) const {
    return static_cast<int>(std::floor((x - origin.x()) / cell_m));
  }
  [[nodiscard]] bool IsInside(int row, int col) const {
    return row >= 0 && col >= 0 && row < rows && col < cols;
  }
};

/// Values on a grid are an Image with rows × cols of its frame: row 0 is the lowest y.

}  // namespace enfilade
