// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/surface_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/baselines/surface_rooms.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr const char* kBox = "room 0,0 4,0 4,3 0,3 height 2.6 | camera 1,1";

// The face of the box that a point of this normal lies on, as its distance from it.
double GapToBox(const Vector3d& p, const Vector3d& normal) {
  if (normal.z() > 0.9) return p.z();
  if (normal.z() < -0.9) return p.z() - 2.6;
  if (normal.x() > 0.9) return p.x();
  if (normal.x() < -0.9) return p.x() - 4;
  if (normal.y() > 0.9) return p.y();
  return normal.y() < -0.9 ? p.y() - 3 : std::numeric_limits<double>::infinity();
}

TEST(SurfacePoints, LieOnWallsFloorAndCeiling) {
  const SurfaceRooms rooms(kBox);
  // As many as pixels of 512 x 256 evenly over the sphere.
  EXPECT_NEAR(static_cast<double>(rooms.points.size()), 512 * 256 * 2 / M_PI, 200);
  int num_askew = 0;
  for (const ScenePoint& point : rooms.points) {
    EXPECT_EQ(point.view_idx, std::vector<int>{0});
    EXPECT_NEAR(point.normal.norm(), 1, 1e-9);
    const Vector3d in_home = rooms.structure.home_from_world * point.position;
    const double gap = GapToBox(in_home, rooms.structure.home_from_world.rotation * point.normal);
    num_askew += std::abs(gap) > 1e-3;
  }
  // Columns on a corner.
  EXPECT_LT(num_askew, 0.005 * static_cast<double>(rooms.points.size()));
}

TEST(SurfacePoints, AreTheSameForAnyNumberOfThreads) {
  const SurfaceRooms rooms("room 0,0 4,0 4,3 0,3 | camera 1,1 | camera 3,2 | camera 1,2");
  RunContext context(3);
  const std::vector<ScenePoint> points = SurfacePoints(rooms.scene, rooms.structure, context);
  ASSERT_EQ(points.size(), rooms.points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].position, rooms.points[i].position);
    EXPECT_EQ(points[i].view_idx, rooms.points[i].view_idx);
  }
}

TEST(SurfacePoints, LeaveOutWhatNobodySaw) {
  SurfaceRooms rooms(kBox);
  WallProfile& profile = rooms.structure.profiles[0];
  std::fill_n(profile.is_seen.begin(), profile.is_seen.size() / 2, uint8_t{0});
  profile.wall_m.back() = std::numeric_limits<float>::quiet_NaN();
  RunContext context(1);
  const std::vector<ScenePoint> points = SurfacePoints(rooms.scene, rooms.structure, context);
  EXPECT_NEAR(static_cast<double>(points.size()), 0.5 * static_cast<double>(rooms.points.size()),
              0.01 * static_cast<double>(rooms.points.size()));
  for (const ScenePoint& point : points) EXPECT_TRUE(point.position.allFinite());
}

TEST(SurfacePoints, TakeTheScenesOwnCloudWhereItHasOne) {
  SurfaceRooms rooms(kBox);
  ScenePoint point;
  point.position = {1, 2, 3};
  point.normal = {0, 0, 1};
  point.view_idx = {0};
  ScenePoint no_normal = point, no_view = point, not_finite = point;
  no_normal.normal.setZero();
  no_view.view_idx.clear();
  not_finite.position.x() = std::numeric_limits<double>::quiet_NaN();
  rooms.scene.points.assign(kMinSurfacePoints, point);
  for (const ScenePoint& bad : {no_normal, no_view, not_finite}) rooms.scene.points.push_back(bad);
  RunContext context(1);
  EXPECT_EQ(SurfacePoints(rooms.scene, rooms.structure, context).size(), kMinSurfacePoints);
  rooms.scene.points.erase(rooms.scene.points.begin());
  EXPECT_EQ(SurfacePoints(rooms.scene, rooms.structure, context).size(), rooms.points.size());
}

}  // namespace
}  // namespace enfilade
