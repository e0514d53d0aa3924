// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

struct Rectangle {
  Eigen::Vector2d min, max;
  [[nodiscard]] Eigen::Vector2d Size() const { return max - min; }
  [[nodiscard]] Eigen::Vector2d Center() const { return 0.5 * (min + max); }
  [[nodiscard]] double Area() const { return Size().prod(); }
};

/// Whether two rectangles come nearer to each other than `margin_m` along both axes.
[[nodiscard]] inline bool AreNear(const Rectangle& a, const Rectangle& b, double margin_m) {
  return ((a.min - b.max).array() < margin_m).all() && ((b.min - a.max).array() < margin_m).all();
}

/// Places along the middle of the rectangle's longer side, evenly spaced, at most `spacing_m` apart
/// and half of that from its ends.
[[nodiscard]] inline Ring2 PlacesAlong(const Rectangle& r, double spacing_m) {
  const int axis = r.Size().x() > r.Size().y() ? 0 : 1;
  const int count = std::max(1, static_cast<int>(std::ceil(r.Size()[axis] / spacing_m)));
  Ring2 places(static_cast<size_t>(count), r.Center());
  for (int i = 0; i < count; ++i)
    places[static_cast<size_t>(i)][axis] = r.min[axis] + (i + 0.5) * r.Size()[axis] / count;
  return places;
}

/// Counter-clockwise from `min`.
[[nodiscard]] inline Ring2 RingOf(const Rectangle& r) {
  return {r.min, {r.max.x(), r.min.y()}, r.max, {r.min.x(), r.max.y()}};
}

/// Mirrors a ring about the middle of the rectangle, keeping it counter-clockwise.
inline void Mirror(Ring2& ring, const Rectangle& about, int axis) {
  for (Eigen::Vector2d& p : ring) p[axis] = about.min[axis] + about.max[axis] - p[axis];
  std::reverse(ring.begin(), ring.end());
}

}  // namespace enfilade
