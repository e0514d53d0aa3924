// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// Moves every edge of the polygons, which have the rooms inside, along its normal onto the wall
/// evidence within reach_m; the edges beside it become longer or shorter. Edges stay where the move
/// would break a polygon, and where two faces of one wall would fall together: evidence too blurred
/// to tell them apart. Jogs that become shorter than min_jog_m are straightened. Returns the number
/// of edges moved.
int SlideToEvidence(const LoopField& field, double reach_m, double min_jog_m,
                    std::vector<Polygon2>& polygons);

/// True when a ring of the polygon (0: the outer one, then the holes) is simple and 5 cm away from
/// the others, and a hole lies inside the outer ring.
[[nodiscard]] bool IsValidRing(const Polygon2& polygon, size_t ring_idx);

/// How surely a wall from a to b lies where it does.
using WallWeight = std::function<double(const Eigen::Vector2d& a, const Eigen::Vector2d& b)>;
[[nodiscard]] double LengthOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Where a jog shorter than min_jog_m parts two parallel walls, puts both on the line of the one
/// that weighs more; not if that would break the polygon.
void StraightenJogs(double min_jog_m, const WallWeight& weight, Polygon2& polygon);

}  // namespace enfilade
