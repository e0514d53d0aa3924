// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "point_evidence.h"

#include "enfilade/base/check.h"
#include "enfilade/evidence/point_labels.h"
#include "enfilade/evidence/ray_traversal.h"

namespace enfilade {
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
    const bool is_outside = !point.position.allFinite() ||
                            !IsAtStorey(point.position.z(), points.floor_z, points.ceiling_z);
    if (is_outside) continue;
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
    if (LabelOfPoint(point, points.floor_z, points.ceiling_z) != SurfaceLabel::kWall) continue;
    const int row = frame.Row(position.y()), col = frame.Col(position.x());
    if (!frame.IsInside(row, col)) continue;
    counts.wall(row, col) += 1;
    ++counts.num_wall_points;
  }
  return counts;
}

}  // namespace enfilade
