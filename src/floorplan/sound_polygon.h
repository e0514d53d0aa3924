// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// Rooms that have less in common do not overlap: rounding.
inline constexpr double kMaxOverlap_m2 = 1e-6;

/// The part of a region with the largest area, the first of equals; empty when there is none.
[[nodiscard]] Polygon2 LargestPart(const MultiPolygon2& region);

/// Of all rings.
[[nodiscard]] int NumVertices(const Polygon2& polygon);

/// RemoveCollinear on every ring; rings that have no area go.
[[nodiscard]] Polygon2 WithoutCollinear(Polygon2 polygon, double tolerance_m);

/// A polygon whose rings lie apart, without needless vertices. Where a hole touches the outer ring
/// or another hole, as results of boolean operations may, the two are joined: a pillar that touches
/// a wall is part of it. Such polygons lose some square centimetres, all others nothing.
[[nodiscard]] Polygon2 WithRingsApart(Polygon2 polygon, double tolerance_m);

/// WithRingsApart of the largest part.
[[nodiscard]] Polygon2 LargestRoom(const MultiPolygon2& region, double tolerance_m);

}  // namespace enfilade
