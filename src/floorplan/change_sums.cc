// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/change_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace enfilade {
namespace {

using Eigen::Vector2d;

/// Where a walk crosses a row: downwards it begins a region on its left, upwards it ends one.
struct Crossing {
  double x = 0;
  int change = 0;
};

std::vector<Crossing> CrossingsAt(const Ring2& walk, double y) {
  std::vector<Crossing> crossings;
  for (size_t i = 0; i < walk.size(); ++i) {
    const Vector2d &a = walk[i], &b = walk[(i + 1) % walk.size()];
    if ((a.y() > y) == (b.y() > y)) continue;
    crossings.push_back(
        {a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()), a.y() > y ? 1 : -1});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  return crossings;
}

}  // namespace

EvidenceSums::EvidenceSums(const LoopField& field, int first_row, int first_col,
                           const ImageU8& foreign)
    : cell_m_(field.frame.cell_m),
      origin_(field.frame.origin + cell_m_ * Vector2d(first_col, first_row)),
      rows_(foreign.rows()),
      cols_(foreign.cols()),
      sums_(static_cast<size_t>(rows_) * static_cast<size_t>(cols_ + 1)) {
  auto sum = sums_.begin();
  for (int row = 0; row < rows_; ++row, ++sum) {
    for (int col = 0; col < cols_; ++col, ++sum) {
      const double freeness = field.freeness(first_row + row, first_col + col);
      *(sum + 1) = {sum->free + std::max(freeness, 0.0), sum->solid + std::max(-freeness, 0.0),
                    sum->foreign + foreign(row, col)};
    }
  }
}

bool EvidenceSums::Covers(const Ring2& ring) const {
  return std::all_of(ring.begin(), ring.end(), [&](const Vector2d& p) {
    const Vector2d cells = (p - origin_) / cell_m_;
    return cells.x() >= 0 && cells.y() >= 0 && cells.x() <= cols_ && cells.y() <= rows_;
  });
}

EvidenceSums::Sum EvidenceSums::Before(int row, double columns) const {
  const int col = std::clamp(static_cast<int>(columns), 0, cols_ - 1);
  const double share = columns - col;
  const Sum* sum =
      &sums_[static_cast<size_t>(row) * static_cast<size_t>(cols_ + 1) + static_cast<size_t>(col)];
  const Sum &a = sum[0], &b = sum[1];
  return {a.free + share * (b.free - a.free), a.solid + share * (b.solid - a.solid),
          a.foreign + share * (b.foreign - a.foreign)};
}

ChangeSums EvidenceSums::Measure(const Ring2& change) const {
  Ring2 walk;  // in cells of the window
  std::vector<double> heights;
  for (const Vector2d& p : change) {
    walk.emplace_back((p - origin_) / cell_m_);
    heights.push_back(walk.back().y());
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const int first = static_cast<int>(std::ceil(*low)), last = static_cast<int>(std::floor(*high));
  for (int row = first; row <= last; ++row) heights.push_back(row);
  std::sort(heights.begin(), heights.end());
  ChangeSums total;
  const double cell_m2 = cell_m_ * cell_m_;
  for (size_t i = 0; i + 1 < heights.size(); ++i) {
    const double y = 0.5 * (heights[i] + heights[i + 1]);
    const double area_m2 = (heights[i + 1] - heights[i]) * cell_m2;  // of a cell's part
    const int row = std::clamp(static_cast<int>(y), 0, rows_ - 1);
    const std::vector<Crossing> crossings = CrossingsAt(walk, y);
    int times = 0;
    for (size_t k = 0; k + 1 < crossings.size(); ++k) {
      times += crossings[k].change;
      if (times == 0) continue;
      const Sum before = Before(row, crossings[k].x), until = Before(row, crossings[k + 1].x);
      if (times < 0) {
        total.free_lost_m2 -= times * area_m2 * (until.free - before.free);
      } else {
        total.solid_gained_m2 += times * area_m2 * (until.solid - before.solid);
        total.foreign_gained_m2 += times * area_m2 * (until.foreign - before.foreign);
      }
    }
  }
  return total;
}

}  // namespace enfilade
