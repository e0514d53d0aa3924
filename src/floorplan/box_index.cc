// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/box_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace enfilade {
namespace {

constexpr double kMinBin_m = 0.5;

}  // namespace

BoxIndex::BoxIndex(std::vector<Box2> boxes) : boxes_(std::move(boxes)) {
  for (const Box2& box : boxes_) bounds_.extend(box);
  if (bounds_.isEmpty()) return;
  const Eigen::Vector2d size = bounds_.sizes();
  const double num_boxes = static_cast<double>(boxes_.size());
  // The second bound is for boxes in a row.
  bin_m_ = std::max({kMinBin_m, std::sqrt(size.x() * size.y() / num_boxes),
                     (size.x() + size.y()) / (2 * num_boxes)});
  cols_ = static_cast<int>(size.x() / bin_m_) + 1;
  rows_ = static_cast<int>(size.y() / bin_m_) + 1;
  first_.assign(static_cast<size_t>(rows_) * static_cast<size_t>(cols_) + 1, 0);
  for (const Box2& box : boxes_) ForBins(box, [&](size_t bin) { ++first_[bin + 1]; });
  for (size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
  indices_.resize(first_.back());
  std::vector<size_t> next = first_;
  for (size_t i = 0; i < boxes_.size(); ++i)
    ForBins(boxes_[i], [&](size_t bin) { indices_[next[bin]++] = i; });
}

template <typename Visit>
void BoxIndex::ForBins(const Box2& box, const Visit& visit) const {
  const Box2 part = box.intersection(bounds_);
  if (part.isEmpty()) return;
  const auto bin_of = [&](double distance_m, int count) {
    return std::clamp(static_cast<int>(distance_m / bin_m_), 0, count - 1);
  };
  const Eigen::Vector2d low = part.min() - bounds_.min(), high = part.max() - bounds_.min();
  for (int row = bin_of(low.y(), rows_); row <= bin_of(high.y(), rows_); ++row) {
    for (int col = bin_of(low.x(), cols_); col <= bin_of(high.x(), cols_); ++col)
      visit(static_cast<size_t>(row) * static_cast<size_t>(cols_) + static_cast<size_t>(col));
  }
}

std::vector<size_t> BoxIndex::Touching(const Box2& box) const {
  std::vector<size_t> found;
  ForBins(box, [&](size_t bin) {
    for (size_t i = first_[bin]; i < first_[bin + 1]; ++i) {
      if (boxes_[indices_[i]].intersects(box)) found.push_back(indices_[i]);
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

BoxIndex IndexWalls(const std::vector<Wall>& walls) {
  std::vector<Box2> boxes;
  for (const Wall& wall : walls)
    boxes.push_back(Grown(BoxOf(wall.a, wall.b), AsideOf((wall.b - wall.a).norm())));
  return BoxIndex(std::move(boxes));
}

}  // namespace enfilade
