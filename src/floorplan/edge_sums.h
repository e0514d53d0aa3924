// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "src/floorplan/facade.h"

namespace enfilade {

/// Means of a facade's edges over parts of its columns and rows, each in constant time.
class EdgeSums {
 public:
  explicit EdgeSums(const Facade& facade)
      : facade_(facade),
        upright_(facade.rows() + 1, facade.cols()),
        level_(facade.rows(), facade.cols() + 1) {
    for (int r = 0; r < facade.rows(); ++r) {
      for (int c = 0; c < facade.cols(); ++c) {
        upright_(r + 1, c) = upright_(r, c) + facade.upright()(r, c);
        level_(r, c + 1) = level_(r, c) + facade.level()(r, c);
      }
    }
  }

  [[nodiscard]] int RowAt(double height_m) const {
    return std::clamp(static_cast<int>(std::lround(height_m / facade_.step_m())), 0,
                      facade_.rows());
  }
  /// |mean| of upright edges of a column over rows [first, last): large when one straight edge runs
  /// through all of them.
  [[nodiscard]] float Upright(int col, int first, int last) const {
    if (last <= first) return 0;
    return std::abs(upright_(last, col) - upright_(first, col)) / static_cast<float>(last - first);
  }
  /// |mean| of level edges of a row over columns [first, last).
  [[nodiscard]] float Level(int row, int first, int last) const {
    if (last <= first || row >= facade_.rows()) return 0;
    return std::abs(level_(row, last) - level_(row, first)) / static_cast<float>(last - first);
  }

 private:
  const Facade& facade_;
  ImageF upright_, level_;
};

}  // namespace enfilade
