// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace enfilade {

/// A closed ring of vertices, implicitly closed, no repeated vertex.
using Ring2 = std::vector<Eigen::Vector2d>;

/// A region of the plane: outer ring counter-clockwise, holes clockwise.
struct Polygon2 {
  Ring2 outer;
  std::vector<Ring2> holes;
};

/// A region of several parts, disjoint but for shared points.
using MultiPolygon2 = std::vector<Polygon2>;

/// Outer ring, then the holes.
[[nodiscard]] std::vector<Ring2> RingsOf(const Polygon2& polygon);

/// Signed area, positive when counter-clockwise (shoelace formula).
[[nodiscard]] double SignedArea(const Ring2& ring);
/// Area of the outer ring less the holes.
[[nodiscard]] double Area(const Polygon2& polygon);
[[nodiscard]] double Area(const MultiPolygon2& region);
[[nodiscard]] double Perimeter(const Ring2& ring);

/// True when `p` lies inside (crossing number; points on the boundary may go either way).
[[nodiscard]] bool Contains(const Ring2& ring, const Eigen::Vector2d& p);
[[nodiscard]] bool Contains(const Polygon2& polygon, const Eigen::Vector2d& p);

/// Distance from `p` to the segment ab.
[[nodiscard]] double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                       const Eigen::Vector2d& b);

/// Distance from `p`, inside or outside, to the nearest edge of the ring.
[[nodiscard]] double DistanceToRing(const Ring2& ring, const Eigen::Vector2d& p);

/// Distance along the unit `direction` from `origin` to the first crossing of the ring; infinity
/// when there is none. From inside there is always one: a ray into a corner cannot slip between the
/// two edges. A ray that only touches the ring, or runs along an edge, may pass it.
[[nodiscard]] double RayDistance(const Ring2& ring, const Eigen::Vector2d& origin,
                                 const Eigen::Vector2d& direction);

/// The ring without vertices that repeat their predecessor within `tolerance_m` or lie on the
/// segment between their neighbours within it, taken away one by one. A ring without area shrinks
/// to two vertices. Cost O(n²) when many vertices go.
[[nodiscard]] Ring2 RemoveCollinear(const Ring2& ring, double tolerance_m = 1e-9);

/// True when the ring has at least three vertices and no two edges touch but neighbours at their
/// shared vertex. Cost O(n²).
[[nodiscard]] bool IsSimple(const Ring2& ring);

/// Geometry as text, for tests: "0,0 4,0 4,3 0,3". Throws std::logic_error on malformed text.
[[nodiscard]] Ring2 ParseRing(std::string_view text);
/// The inverse of ParseRing: every coordinate in the shortest form that reads back the same.
[[nodiscard]] std::string RingToText(const Ring2& ring);

}  // namespace enfilade
