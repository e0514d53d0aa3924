// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// Triangles over the vertices of a polygon, counter-clockwise.
struct Triangulation2 {
  std::vector<Eigen::Vector2d> vertices;      ///< outer ring, then the holes, in order
  std::vector<std::array<int, 3>> triangles;  ///< indices into `vertices`
};

/// Constrained Delaunay triangulation of the polygon's interior (CGAL). No vertex is added, so
/// neighbouring faces that share the ring stay watertight. The rings must be simple and disjoint
/// (std::logic_error otherwise).
[[nodiscard]] Triangulation2 Triangulate(const Polygon2& polygon);

}  // namespace enfilade
