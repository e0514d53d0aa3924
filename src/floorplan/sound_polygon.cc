// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/sound_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kTouch_m = 1e-5;
constexpr double kBridge_m = 0.02;  // by which touching rings are joined
constexpr int kMaxRounds = 4;

// Squares about the points at which rings touch each other.
MultiPolygon2 Bridges(const Polygon2& polygon) {
  constexpr double kHalf_m = 0.5 * kBridge_m;
  MultiPolygon2 bridges;
  const std::vector<Ring2> rings = RingsOf(polygon);
  for (size_t i = 0; i < rings.size(); ++i) {
    for (size_t j = 0; j < rings.size(); ++j) {
      if (i == j) continue;
      for (const Vector2d& p : rings[i]) {
        if (DistanceToRing(rings[j], p) > kTouch_m) continue;
        bridges.push_back({{p + Vector2d(-kHalf_m, -kHalf_m), p + Vector2d(kHalf_m, -kHalf_m),
                            p + Vector2d(kHalf_m, kHalf_m), p + Vector2d(-kHalf_m, kHalf_m)},
                           {}});
      }
    }
  }
  return bridges;
}

}  // namespace

Polygon2 LargestPart(const MultiPolygon2& region) {
  const auto largest =
      std::max_element(region.begin(), region.end(),
                       [](const Polygon2& a, const Polygon2& b) { return Area(a) < Area(b); });
  return largest != region.end() ? *largest : Polygon2{};
}

int NumVertices(const Polygon2& polygon) {
  size_t count = 0;
  for (const Ring2& ring : RingsOf(polygon)) count += ring.size();
  return static_cast<int>(count);
}

Polygon2 WithoutCollinear(Polygon2 polygon, double tolerance_m) {
  const auto has_area = [](const Ring2& ring) { return ring.size() >= 3; };
  polygon.outer = RemoveCollinear(polygon.outer, tolerance_m);
  if (!has_area(polygon.outer)) return {};
  for (Ring2& hole : polygon.holes) hole = RemoveCollinear(hole, tolerance_m);
  std::erase_if(polygon.holes, [&](const Ring2& hole) { return !has_area(hole); });
  return polygon;
}

Polygon2 WithRingsApart(Polygon2 polygon, double tolerance_m) {
  polygon = WithoutCollinear(std::move(polygon), tolerance_m);
  if (polygon.holes.empty()) return polygon;
  const MultiPolygon2 region = Union({polygon});
  if (std::abs(Area(region) - Area(polygon)) > 0.5 * kMaxOverlap_m2)  // rings cross each other
    polygon = WithoutCollinear(LargestPart(region), tolerance_m);
  for (int round = 0; round < kMaxRounds; ++round) {
    const MultiPolygon2 bridges = Bridges(polygon);
    if (bridges.empty()) return polygon;
    polygon = WithoutCollinear(LargestPart(Difference({polygon}, bridges)), tolerance_m);
  }
  return Bridges(polygon).empty() ? polygon : Polygon2{};
}

Polygon2 LargestRoom(const MultiPolygon2& region, double tolerance_m) {
  return WithRingsApart(LargestPart(region), tolerance_m);
}

}  // namespace enfilade
