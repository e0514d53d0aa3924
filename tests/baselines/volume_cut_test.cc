// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/volume_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/boolean.h"
#include "tests/baselines/surface_rooms.h"
#include "tests/support/floorplan_checks.h"
#include "tests/support/model_checks.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr const char* kBox = "room 0,0 4,0 4,3 0,3 height 2.6 | camera 1,1 | camera 3,2";

SurfaceReport Cut(const SurfaceRooms& rooms, const VolumeCutOptions& options = {},
                  int num_threads = 1) {
  RunContext context(num_threads);
  SurfaceReport report = CutVolume(rooms.scene, rooms.structure, rooms.points, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

TEST(CutVolume, FindsABox) {
  const SurfaceReport report = Cut(SurfaceRooms(kBox));
  EXPECT_EQ(report.outcome, SurfaceOutcome::kFound);
  EXPECT_EQ(report.reason, "");
  ExpectWatertight(report.model);
  ASSERT_EQ(report.model.faces.size(), 6u);
  EXPECT_NEAR(EnclosedVolumes(report.model)[std::pair(0, 0)], 4 * 3 * 2.6, 0.05);
  ASSERT_EQ(RegionOf(report).size(), 1u);
  EXPECT_GT(AreaIou(RegionOf(report), {{ParseRing("0,0 4,0 4,3 0,3"), {}}}), 0.998);
  EXPECT_EQ(report.plan.storeys[0].walls[0].seen, WallSeen::kSeen);
  EXPECT_NEAR(report.plan.storeys[0].rooms[0].ceiling_z, 2.6, 1e-6);
}

// Large voxels find the walls as well, for they move where the points are.
TEST(CutVolume, FindsWallsBetweenLargeVoxels) {
  const SurfaceReport report = Cut(SurfaceRooms(kBox), {.voxel_m = 0.2});
  ExpectWatertight(report.model);
  EXPECT_GT(AreaIou(RegionOf(report), {{ParseRing("0,0 4,0 4,3 0,3"), {}}}), 0.99);
}

TEST(CutVolume, FindsRoomsAndTheirDoor) {
  const SurfaceRooms rooms(
      "room 0,0 4,0 4,3 0,3 height 2.6 | room 4.2,0 7,0 7,4 4.2,4 height 2.6 | door 4,1 4,1.9 | "
      "camera 2,1.5 | camera 5.5,1.5");
  const SurfaceReport report = Cut(rooms);
  ExpectWatertight(report.model);
  // One part, for the door is open.
  ASSERT_EQ(RegionOf(report).size(), 1u);
  const MultiPolygon2 truth = {{ParseRing("0,0 4,0 4,3 0,3"), {}},
                               {ParseRing("4.2,0 7,0 7,4 4.2,4"), {}},
                               {ParseRing("4,1 4.2,1 4.2,1.9 4,1.9"), {}}};
  EXPECT_GT(AreaIou(RegionOf(report), Union(truth)), 0.98);
}

TEST(CutVolume, StandsNoise) {
  SurfaceRooms rooms(kBox);
  std::mt19937 random(1);
  std::normal_distribution<> noise(0, 0.02);
  for (ScenePoint& point : rooms.points) point.position += noise(random) * point.normal;
  const SurfaceReport report = Cut(rooms);
  ExpectWatertight(report.model);
  EXPECT_GT(AreaIou(RegionOf(report), {{ParseRing("0,0 4,0 4,3 0,3"), {}}}), 0.985);
  EXPECT_LT(report.model.faces.size(), 40u);
}

// Rays through the walls, and rays that end in mid-air.
TEST(CutVolume, StandsOutliers) {
  SurfaceRooms rooms(kBox);
  std::mt19937 random(2);
  std::uniform_real_distribution<> factor(0.3, 2);
  for (size_t i = 0; i < rooms.points.size(); i += 20) {
    ScenePoint& point = rooms.points[i];
    const Vector3d& camera =
        rooms.scene.views[static_cast<size_t>(point.view_idx[0])].world_from_cam.translation;
    point.position = camera + factor(random) * (point.position - camera);
  }
  const SurfaceReport report = Cut(rooms);
  ExpectWatertight(report.model);
  EXPECT_GT(AreaIou(RegionOf(report), {{ParseRing("0,0 4,0 4,3 0,3"), {}}}), 0.99);
}

TEST(CutVolume, IsTheSameForAnyNumberOfThreads) {
  const SurfaceRooms rooms(kBox, {.sigma_relative = 0.02, .outlier_share = 0.05, .seed = 3});
  const VolumeCutOptions small = {.voxel_m = 0.15, .max_range_m = 5};
  const SurfaceReport one = Cut(rooms, small, 1), three = Cut(rooms, small, 3);
  ASSERT_EQ(one.model.faces.size(), three.model.faces.size());
  for (size_t i = 0; i < one.model.faces.size(); ++i)
    EXPECT_EQ(one.model.faces[i].vertices, three.model.faces[i].vertices);
}

TEST(CutVolume, SaysWhyThereIsNoSurface) {
  SurfaceRooms rooms(kBox);
  EXPECT_THAT(Cut(rooms, {.max_megavoxels = 0.1}).reason, HasSubstr("limit is 0.1"));
  // One thin beam.
  SurfaceRooms beam(kBox);
  beam.points.assign(kMinSurfacePoints, beam.points[beam.points.size() / 4]);
  EXPECT_EQ(Cut(beam).reason, "no part inside holds a camera");
  for (ScenePoint& point : rooms.points)
    point.position.x() = std::numeric_limits<double>::quiet_NaN();
  const SurfaceReport report = Cut(rooms);
  EXPECT_EQ(report.outcome, SurfaceOutcome::kNoSurface);
  EXPECT_EQ(
      report.reason,
      "only 0 points with a normal and a view lie within range and apart, a surface takes 100");
  rooms.points.clear();
  EXPECT_EQ(Cut(rooms).outcome, SurfaceOutcome::kNoSurface);
}

TEST(CutVolume, Stops) {
  const SurfaceRooms rooms(kBox);
  RunContext context(1);
  context.RequestStop();
  EXPECT_THROW((void)CutVolume(rooms.scene, rooms.structure, rooms.points, {}, context),
               StoppedError);
}

}  // namespace
}  // namespace enfilade
