// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "point_evidence.h"

#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/evidence/ray_traversal.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr double kHeightTolerance = 0.3;
const double kCosTolerance = std::cos(DegToRad(15));
const double kSinTolerance = std::sin(DegToRad(15));

}  // namespace

PointLabel LabelOfPoint(const ScenePoint& point, double floor_z, double ceiling_z) {
  const double z = point.position.z(), nz = point.normal.z();
  const bool has_normal = point.normal.squaredNorm() > 0.5;
  if (!point.position.allFinite() || z < floor_z - kHeightTolerance ||
      z > ceiling_z + kHeightTolerance) {
    return PointLabel::kOutside;
  }
  const bool at_floor = z <= floor_z + kHeightTolerance,
             at_ceiling = z >= ceiling_z - kHeightTolerance;
  if (!has_normal) {
    if (at_floor) return PointLabel::kFloor;
    return at_ceiling ? PointLabel::kCeiling : PointLabel::kWall;
  }
  if (at_floor && nz >= kCosTolerance) return PointLabel::kFloor;
  if (at_ceiling && nz <= -kCosTolerance) return PointLabel::kCeiling;
  if (z > floor_z && z < ceiling_z && std::abs(nz) <= kSinTolerance) return PointLabel::kWall;
  return PointLabel::kClutter;
}

void CountRay(const GridFrame& frame, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double ray_margin_m, ImageF& rays) {
  const double length = (to - from).norm();
  if (length <= ray_margin_m) return;
  TraverseCells(frame, from, from + (1 - ray_margin_m / length) * (to - from),
                [&](int row, int col) {
                  rays(row, col) += 1;
                  return true;
                });
}

PointCounts CountPoints(const GridFrame& frame, const EvidencePoints& points, double ray_margin_m,
                        double max_range_m) {
  PointCounts counts{ImageF(frame.rows, frame.cols), ImageF(frame.rows, frame.cols), 0, 0};
  for (const ScenePoint& point : points.points) {
    const PointLabel label = LabelOfPoint(point, points.floor_z, points.ceiling_z);
    if (label == PointLabel::kOutside) continue;
    const Eigen::Vector2d position = point.position.head<2>();
    ++counts.num_ray_points;
    for (int view_idx : point.view_idx) {
      ENFILADE_CHECK(view_idx >= 0 &&
                     static_cast<size_t>(view_idx) < points.camera_positions.size());
      const Eigen::Vector2d camera = points.camera_positions[view_idx].head<2>();
      if ((position - camera).norm() <= max_range_m) {
        CountRay(frame, camera, position, ray_margin_m, counts.rays);
      }
    }
    if (label != PointLabel::kWall) continue;
    const int row = frame.Row(position.y()), col = frame.Col(position.x());
    if (!frame.IsInside(row, col)) continue;
    counts.wall(row, col) += 1;
    ++counts.num_wall_points;
  }
  return counts;
}

}  // namespace enfilade
