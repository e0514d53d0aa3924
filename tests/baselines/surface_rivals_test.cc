// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "enfilade/base/errors.h"
#include "enfilade/baselines/poisson_surface.h"
#include "enfilade/baselines/polygonal_surface.h"
#include "enfilade/geometry/boolean.h"
#include "tests/baselines/surface_rooms.h"
#include "tests/support/floorplan_checks.h"
#include "tests/support/model_checks.h"

namespace enfilade {
namespace {

using testing::HasSubstr;

constexpr const char* kBox = "room 0,0 4,0 4,3 0,3 height 2.6 | camera 1,1 | camera 3,2";
const MultiPolygon2 kBoxRegion = {{ParseRing("0,0 4,0 4,3 0,3"), {}}};

// A quarter of the usual points, for speed.
SurfaceReport Poisson(const SurfaceRooms& rooms,
                      const PoissonOptions& options = {.spacing_m = 0.2}) {
  RunContext context(1);
  SurfaceReport report =
      ReconstructPoisson(rooms.scene, rooms.structure, rooms.points, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

SurfaceReport Polygonal(const SurfaceRooms& rooms,
                        const PolygonalOptions& options = {.spacing_m = 0.2}) {
  RunContext context(1);
  SurfaceReport report =
      ReconstructPolygonal(rooms.scene, rooms.structure, rooms.points, options, context);
  ExpectValidFloorplan(report.plan);
  return report;
}

void AddNoise(double sigma_m, SurfaceRooms& rooms) {
  std::mt19937 random(1);
  std::normal_distribution<> noise(0, sigma_m);
  for (ScenePoint& point : rooms.points) point.position += noise(random) * point.normal;
}

TEST(ReconstructPoisson, FindsABox) {
  SurfaceRooms rooms(kBox);
  const SurfaceReport report = Poisson(rooms);
  EXPECT_EQ(report.outcome, SurfaceOutcome::kFound);
  ExpectWatertight(report.model);
  // Corners are rounded over about a spacing of the points.
  EXPECT_NEAR(EnclosedVolumes(report.model)[std::pair(0, 0)], 4 * 3 * 2.6, 1);
  EXPECT_GT(AreaIou(RegionOf(report), kBoxRegion), 0.95);
  AddNoise(0.02, rooms);
  EXPECT_GT(AreaIou(RegionOf(Poisson(rooms)), kBoxRegion), 0.93);
}

TEST(ReconstructPolygonal, FindsABox) {
  SurfaceRooms rooms(kBox);
  const SurfaceReport report = Polygonal(rooms);
  EXPECT_EQ(report.reason, "");
  ExpectWatertight(report.model);
  EXPECT_EQ(report.model.faces.size(), 6u);
  EXPECT_NEAR(EnclosedVolumes(report.model)[std::pair(0, 0)], 4 * 3 * 2.6, 0.05);
  EXPECT_GT(AreaIou(RegionOf(report), kBoxRegion), 0.998);
  AddNoise(0.02, rooms);
  EXPECT_GT(AreaIou(RegionOf(Polygonal(rooms)), kBoxRegion), 0.98);
}

TEST(ReconstructPolygonal, IsTheSameEveryTime) {
  const SurfaceRooms rooms(kBox);
  const SurfaceReport one = Polygonal(rooms), other = Polygonal(rooms);
  ASSERT_EQ(one.model.faces.size(), other.model.faces.size());
  for (size_t i = 0; i < one.model.faces.size(); ++i)
    EXPECT_EQ(one.model.faces[i].vertices, other.model.faces[i].vertices);
}

TEST(ReconstructPolygonal, SaysWhyThereIsNoSurface) {
  const SurfaceRooms rooms(kBox);
  EXPECT_THAT(Polygonal(rooms, {.spacing_m = 0.4, .min_plane_m2 = 50}).reason,
              HasSubstr("make 0 planes, a closed surface takes 4"));
  // Without its ceiling, or another side, the box does not close.
  EXPECT_EQ(Polygonal(rooms, {.spacing_m = 0.2, .max_planes = 5}).reason,
            "the cheapest choice of faces is none");
}

TEST(SurfaceRivals, WantOrientedPoints) {
  SurfaceRooms rooms(kBox);
  for (ScenePoint& point : rooms.points) point.normal.setZero();
  rooms.points[0].position.x() = std::numeric_limits<double>::quiet_NaN();
  for (const SurfaceReport& report : {Poisson(rooms), Polygonal(rooms)}) {
    EXPECT_EQ(report.outcome, SurfaceOutcome::kNoSurface);
    EXPECT_THAT(report.reason, HasSubstr("only 0 points with a normal"));
  }
  rooms.points.clear();
  EXPECT_EQ(Poisson(rooms).outcome, SurfaceOutcome::kNoSurface);
}

TEST(SurfaceRivals, Stop) {
  const SurfaceRooms rooms(kBox);
  RunContext context(1);
  context.RequestStop();
  EXPECT_THROW((void)ReconstructPoisson(rooms.scene, rooms.structure, rooms.points, {}, context),
               StoppedError);
  EXPECT_THROW((void)ReconstructPolygonal(rooms.scene, rooms.structure, rooms.points, {}, context),
               StoppedError);
}

}  // namespace
}  // namespace enfilade
