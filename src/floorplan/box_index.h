// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

using Box2 = Eigen::AlignedBox2d;

[[nodiscard]] inline Box2 BoxOf(const Ring2& ring) {
  Box2 bounds;
  for (const Eigen::Vector2d& p : ring) bounds.extend(p);
  return bounds;
}

/// How far a line of this length may go aside of one that it counts as parallel to: 11.5°.
[[nodiscard]] inline double AsideOf(double length_m) { return 0.2 * length_m; }

[[nodiscard]] inline Box2 BoxOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// The box grown by a distance on each side; an empty one stays empty.
[[nodiscard]] inline Box2 Grown(const Box2& box, double distance_m) {
  if (box.isEmpty()) return box;
  return {box.min().array() - distance_m, box.max().array() + distance_m};
}

/// Finds those of many boxes that lie at a place, so that what is asked of neighbours need not be
/// asked of all. Boxes are sorted into square bins, of which there are about as many as boxes.
class BoxIndex {
 public:
  explicit BoxIndex(std::vector<Box2> boxes);

  /// Indices of the boxes that `box` touches, ascending.
  [[nodiscard]] std::vector<size_t> Touching(const Box2& box) const;

  /// Of all boxes.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }

 private:
  template <typename Visit>
  void ForBins(const Box2& box, const Visit& visit) const;

  std::vector<Box2> boxes_;
  Box2 bounds_;
  double bin_m_ = 1;
  int rows_ = 1, cols_ = 1;
  std::vector<size_t> first_;    // of each bin in indices_, and their end
  std::vector<size_t> indices_;  // of the boxes in the bins
};

/// The walls by place, each box grown by AsideOf: what lies beside a wall of nearly the same
/// direction, up to d away, touches the wall's own bounds grown by d.
[[nodiscard]] BoxIndex IndexWalls(const std::vector<Wall>& walls);

}  // namespace enfilade
