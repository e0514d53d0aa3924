// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "enfilade/evidence/types.h"

namespace enfilade {

/// Numbers of wall points in, and of rays camera → point across, each cell.
struct PointCounts {
  ImageF wall;
  ImageF rays;
  int64_t num_wall_points = 0;
  int64_t num_ray_points = 0;
};

/// Counts the points that are at the storey: wall points, and the rays to all, to those on the
/// floor up to their foot. A ray stops ray_margin_m short of its point. Checks that every view_idx
/// has a camera position.
[[nodiscard]] PointCounts CountPoints(const GridFrame& frame, const EvidencePoints& points,
                                      double ray_margin_m, double max_range_m);

/// Adds one to the cells that the segment crosses, but for the last ray_margin_m before `to`.
void CountRay(const GridFrame& frame, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double ray_margin_m, ImageF& rays);

}  // namespace enfilade
