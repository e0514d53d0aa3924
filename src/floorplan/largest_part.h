// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// The part of a region with the largest area, the first of equals; empty when there is none.
[[nodiscard]] inline Polygon2 LargestPart(const MultiPolygon2& region) {
  const auto largest =
      std::max_element(region.begin(), region.end(),
                       [](const Polygon2& a, const Polygon2& b) { return Area(a) < Area(b); });
  return largest != region.end() ? *largest : Polygon2{};
}

/// RemoveCollinear on every ring.
[[nodiscard]] inline Polygon2 WithoutCollinear(Polygon2 polygon, double tolerance_m) {
  polygon.outer = RemoveCollinear(polygon.outer, tolerance_m);
  for (Ring2& hole : polygon.holes) hole = RemoveCollinear(hole, tolerance_m);
  return polygon;
}

}  // namespace enfilade
