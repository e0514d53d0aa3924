// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "src/synthetic/rectangle.h"

namespace enfilade {

[[nodiscard]] inline Rectangle BoundsOf(const Ring2& ring) {
  Rectangle bounds{ring[0], ring[0]};
  for (const Eigen::Vector2d& p : ring) {
    bounds.min = bounds.min.cwiseMin(p);
    bounds.max = bounds.max.cwiseMax(p);
  }
  return bounds;
}

/// Whether the insides of two convex rings meet; a ring of two points is a segment (separating
/// axes, Gottschalk et al. 1996). What only touches within `tolerance_m` does not.
[[nodiscard]] inline bool DoConvexOverlap(const Ring2& p, const Ring2& q,
                                          double tolerance_m = 1e-6) {
  const auto is_apart_along_normals_of = [&](const Ring2& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d edge = (ring[(i + 1) % ring.size()] - ring[i]).normalized();
      const Eigen::Vector2d normal(-edge.y(), edge.x());
      const auto less = [&](const auto& a, const auto& b) { return normal.dot(a) < normal.dot(b); };
      const auto [p_low, p_high] = std::minmax_element(p.begin(), p.end(), less);
      const auto [q_low, q_high] = std::minmax_element(q.begin(), q.end(), less);
      if (normal.dot(*p_high - *q_low) < tolerance_m || normal.dot(*q_high - *p_low) < tolerance_m)
        return true;
    }
    return false;
  };
  return !is_apart_along_normals_of(p) && !is_apart_along_normals_of(q);
}

/// Whether a convex ring lies in a polygon; it may touch the boundary.
[[nodiscard]] inline bool IsConvexInside(const Ring2& convex, const Polygon2& polygon) {
  for (const Ring2& ring : RingsOf(polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      if (DoConvexOverlap(convex, {ring[i], ring[(i + 1) % ring.size()]})) return false;
    }
  }
  return Contains(polygon, std::accumulate(convex.begin(), convex.end(), Eigen::Vector2d(0, 0)) /
                               static_cast<double>(convex.size()));
}

}  // namespace enfilade
