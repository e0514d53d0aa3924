// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "enfilade/evidence/types.h"

namespace enfilade {

/// What a point is, from its height and normal (Cabral & Furukawa 2014, supplement).
enum class PointLabel { kFloor, kCeiling, kWall, kClutter, kOutside };

/// Floor and ceiling: within 0.3 m of the height, normal within 15° of vertical. Wall: between the
/// heights, normal within 15° of horizontal, or no normal and more than 0.3 m from both. Outside:
/// below the floor or above the ceiling by more than 0.3 m.
[[nodiscard]] PointLabel LabelOfPoint(const ScenePoint& point, double floor_z, double ceiling_z);

/// Numbers of wall points in, and of rays camera → point across, each cell.
struct PointCounts {
  ImageF wall;
  ImageF rays;
  int64_t num_wall_points = 0;
  int64_t num_ray_points = 0;
};

/// Counts all points but those outside; a ray stops ray_margin_m short of its point. Checks that
/// every view_idx has a camera position.
[[nodiscard]] PointCounts CountPoints(const GridFrame& frame, const EvidencePoints& points,
                                      double ray_margin_m, double max_range_m);

/// Adds one to the cells that the segment crosses, but for the last ray_margin_m before `to`.
void CountRay(const GridFrame& frame, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double ray_margin_m, ImageF& rays);

}  // namespace enfilade
