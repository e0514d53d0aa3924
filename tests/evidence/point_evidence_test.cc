// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evidence/point_evidence.h"

#include <gtest/gtest.h>

#include <numeric>

namespace enfilade {
namespace {

ScenePoint PointAt(double x, double y, double z, const Eigen::Vector3d& normal) {
  ScenePoint point;
  point.position = {x, y, z};
  point.normal = normal;
  point.view_idx = {0};
  return point;
}

TEST(CountPoints, RaysStopShortOfThePoint) {
  GridFrame frame;
  frame.cell_m = 0.1;
  frame.rows = 10;
  frame.cols = 40;
  EvidencePoints points;
  points.camera_positions = {{0.05, 0.55, 1.4}};
  points.ceiling_z = 2.5;
  points.points = {PointAt(3.05, 0.55, 1, {-1, 0, 0}), PointAt(1.05, 0.55, 0, {0, 0, 1}),
                   PointAt(2.05, 0.55, -2, {0, 0, 1})};
  const PointCounts counts = CountPoints(frame, points, 0.2, 15);
  EXPECT_EQ(counts.num_wall_points, 1);
  EXPECT_EQ(counts.num_ray_points, 2);
  EXPECT_EQ(counts.wall(5, 30), 1);
  EXPECT_EQ(counts.rays(5, 0), 2);
  EXPECT_EQ(counts.rays(5, 8), 2);
  EXPECT_EQ(counts.rays(5, 9), 1);
  EXPECT_EQ(counts.rays(5, 28), 1);
  EXPECT_EQ(counts.rays(5, 29), 0);
  EXPECT_EQ(std::accumulate(counts.rays.data().begin(), counts.rays.data().end(), 0.0f), 9 + 29);
}

}  // namespace
}  // namespace enfilade
