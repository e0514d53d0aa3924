// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/point_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

View PanoramaAt(const Vector3d& position) {
  View view;
  view.camera = EquirectangularCamera(64, 32);
  view.world_from_cam.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // looks along +y
  view.world_from_cam.translation = position;
  return view;
}

ScenePoint PointAt(const Vector3d& position, const Vector3d& normal) {
  ScenePoint point;
  point.position = position;
  point.normal = normal;
  return point;
}

// A wall of points across x, 4 m wide and 2.5 m high, every 5 cm, seen from the side of `normal_x`.
void AddWall(double x, double normal_x, double from_y, double to_y,
             std::vector<ScenePoint>& points) {
  for (double y = from_y; y < to_y; y += 0.05) {
    for (double z = 0; z < 2.5; z += 0.05) points.push_back(PointAt({x, y, z}, {normal_x, 0, 0}));
  }
}

TEST(FindViewsOfPoints, WallsHideWhatIsBehindThem) {
  // Two rooms with a wall of two faces between them at x = 3, open at y > 1; the far walls.
  std::vector<ScenePoint> points;
  AddWall(3, -1, -2, 1, points);
  const size_t end_of_near = points.size();
  AddWall(3.12, 1, -2, 1, points);
  const size_t end_of_back = points.size();
  AddWall(6, -1, -2, 2, points);
  const std::vector<View> views = {PanoramaAt({1, 0, 1.4}), PanoramaAt({5, 0, 1.4})};
  RunContext context(2);
  FindViewsOfPoints(views, points, context);
  size_t num_wrong = 0, num_through_door = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const std::vector<int>& seen = points[i].view_idx;
    if (i < end_of_near) {
      num_wrong += seen != std::vector<int>{0};
    } else if (i < end_of_back) {
      num_wrong += seen != std::vector<int>{1};
    } else {
      // From (1, 0) the ray to y on the far wall crosses x = 3 at 0.4 y and x = 3.12 at 0.424 y: it
      // never gets past the wall's end, where y would be 2.36.
      num_wrong += seen != std::vector<int>{1};
      num_through_door += seen.size() > 1;
    }
  }
  EXPECT_EQ(num_through_door, 0u);
  EXPECT_LT(num_wrong, points.size() / 200);
}

TEST(FindViewsOfPoints, ThroughADoor) {
  std::vector<ScenePoint> points;
  AddWall(3, -1, -2, -0.5, points);
  AddWall(3, -1, 0.5, 2, points);
  AddWall(6, -1, -2, 2, points);
  RunContext context(1);
  FindViewsOfPoints(std::vector<View>{PanoramaAt({1, 0, 1.4})}, points, context);
  for (const ScenePoint& point : points) {
    if (point.position.x() < 5) continue;
    // The jambs show y = ±1.25 on the far wall; half a disc and a pixel are left undecided.
    const double y = std::abs(point.position.y());
    if (y < 0.95) {
      EXPECT_THAT(point.view_idx, ElementsAre(0)) << point.position.transpose();
    }
    if (y > 1.35) {
      EXPECT_THAT(point.view_idx, IsEmpty()) << point.position.transpose();
    }
  }
}

TEST(FindViewsOfPoints, NotFromBehindNotWithoutNormalsNotOutsideThePicture) {
  std::vector<ScenePoint> points;
  AddWall(3, -1, -1, 1, points);
  points.push_back(PointAt({2.9, 0, 1.4}, {1, 0, 0}));
  points.push_back(PointAt({2.9, 0, 1.4}, {0, 0, 0}));
  View pinhole = PanoramaAt({1, 0, 1.4});
  pinhole.camera = PinholeCamera(100, 100, 50, 50, 50, 50);  // looks along +y
  RunContext context(1);
  FindViewsOfPoints(std::vector<View>{PanoramaAt({1, 0, 1.4}), pinhole}, points, context);
  EXPECT_THAT(points[0].view_idx, ElementsAre(0));
  EXPECT_THAT(points[points.size() - 2].view_idx, IsEmpty());
  EXPECT_THAT(points[points.size() - 1].view_idx, IsEmpty());
  std::vector<ScenePoint> none;
  FindViewsOfPoints(std::vector<View>{pinhole}, none, context);
}

TEST(FindViewsOfPoints, SameForAnyNumberOfThreads) {
  std::vector<ScenePoint> points;
  AddWall(3, -1, -2, 1, points);
  AddWall(4, -1, -2, 2, points);
  std::vector<ScenePoint> again = points;
  const std::vector<View> views = {PanoramaAt({1, 0, 1.4}), PanoramaAt({0, 1, 1.2}),
                                   PanoramaAt({2, -1, 1})};
  RunContext one(1), three(3);
  FindViewsOfPoints(views, points, one);
  FindViewsOfPoints(views, again, three);
  for (size_t i = 0; i < points.size(); ++i) ASSERT_EQ(points[i].view_idx, again[i].view_idx);
}

}  // namespace
}  // namespace enfilade
