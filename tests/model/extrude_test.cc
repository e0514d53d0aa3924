// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/model/extrude.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "enfilade/geometry/rigid3.h"
#include "tests/support/model_checks.h"
#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

constexpr const char* kRectangle = "0,0 4,0 4,3 0,3";
constexpr const char* kLShape = "0,0 5,0 5,2 3,2 3,4 0,4";
constexpr const char* kPillar = "1,1 1,2 2,2 2,1";

double FaceArea(const ModelFace& face) {
  double area = 0;
  for (const std::array<int, 3>& t : face.triangles) {
    area += 0.5 * (face.vertices[t[1]] - face.vertices[t[0]])
                      .cross(face.vertices[t[2]] - face.vertices[t[0]])
                      .norm();
  }
  return area;
}

TEST(ExtrudeFloorplan, RectangleIsSixFacesThatEncloseItsVolume) {
  const BuildingModel model = ExtrudeFloorplan(MakePlan({MakeRoom(7, kRectangle)}));
  ExpectWatertight(model);
  ASSERT_EQ(model.faces.size(), 6u);
  EXPECT_NEAR(EnclosedVolumes(model).at({0, 7}), 4 * 3 * 2.4, 1e-12);
  EXPECT_EQ(model.faces[0].kind, SurfaceKind::kFloor);
  EXPECT_EQ(model.faces[1].kind, SurfaceKind::kCeiling);
  for (int i = 0; i < 4; ++i) {
    const ModelFace& wall = model.faces[2 + i];
    EXPECT_EQ(wall.kind, SurfaceKind::kWall);
    EXPECT_EQ(wall.wall_id, i);
    const Eigen::Vector3d to_centre = Eigen::Vector3d(2, 1.5, 1.2) - wall.vertices[0];
    EXPECT_GT(wall.normal.dot(to_centre), 0);
  }
  EXPECT_EQ(model.faces[0].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(model.faces[1].normal, Eigen::Vector3d(0, 0, -1));
}

TEST(ExtrudeFloorplan, LShapeAndPillarStayWatertight) {
  const BuildingModel l_shape = ExtrudeFloorplan(MakePlan({MakeRoom(0, kLShape, {}, -0.3, 2.1)}));
  ExpectWatertight(l_shape);
  EXPECT_NEAR(EnclosedVolumes(l_shape).at({0, 0}), 16 * 2.4, 1e-12);

  const BuildingModel pillar = ExtrudeFloorplan(MakePlan({MakeRoom(0, kRectangle, {kPillar})}));
  ExpectWatertight(pillar);
  EXPECT_NEAR(EnclosedVolumes(pillar).at({0, 0}), 11 * 2.4, 1e-12);
  EXPECT_EQ(pillar.faces.size(), 10u);
  EXPECT_NEAR(FaceArea(pillar.faces[0]), 11, 1e-12);
}

TEST(ExtrudeFloorplan, VerticesOnStraightWallsLeaveNoTJunction) {
  const Room room = MakeRoom(0, "0,0 1,0 2.5,0 4,0 4,3 2,3 0,3 0,1.7");
  const BuildingModel model = ExtrudeFloorplan(MakePlan({room}));
  ExpectWatertight(model);
  EXPECT_EQ(model.faces.size(), 10u);
}

TEST(ExtrudeFloorplan, TurnedStarsWithHolesStayWatertight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.3, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    Room room = MakeRoom(0, "0,0 1,0 1,1");
    room.polygon.outer.clear();
    const int num_corners = 3 + trial % 20;
    for (int i = 0; i < num_corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / num_corners;
      const double radius = 3 * uniform(random) + 1;
      room.polygon.outer.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    // A thin triangle about the centre, clockwise: inside every star with five corners or more.
    if (num_corners >= 5) room.polygon.holes.push_back(ParseRing("0,0 0.1,0.15 0.2,0"));
    ExpectWatertight(ExtrudeFloorplan(MakePlan({room})));
  }
}

TEST(ExtrudeFloorplan, RoomsOfSeveralStoreysKeepTheirIds) {
  Floorplan plan = MakePlan({MakeRoom(3, kRectangle), MakeRoom(4, "5,0 8,0 8,3 5,3")});
  plan.storeys.push_back(MakePlan({MakeRoom(3, kLShape, {}, 2.7, 5.0)}).storeys[0]);
  const BuildingModel model = ExtrudeFloorplan(plan);
  ExpectWatertight(model);
  EXPECT_EQ(EnclosedVolumes(model).size(), 3u);
  EXPECT_NEAR(EnclosedVolumes(model).at({1, 3}), 16 * 2.3, 1e-9);
}

TEST(ExtrudeFloorplan, WallIdsComeFromTheWallWithTheLongestCommonPart) {
  Floorplan plan = MakePlan({MakeRoom(0, kRectangle)});
  std::vector<Wall>& walls = plan.storeys[0].walls;
  walls[0].b = {1, 0};  // the lower wall is listed in two parts
  walls.push_back(walls[0]);
  walls.back().id = 12;
  walls.back().a = {1, 0};
  walls.back().b = {4, 0};
  std::erase_if(walls, [](const Wall& wall) { return wall.id == 2; });
  const BuildingModel model = ExtrudeFloorplan(plan);
  EXPECT_EQ(model.faces[2].wall_id, 12);
  EXPECT_EQ(model.faces[4].wall_id, -1);
}

TEST(ExtrudeFloorplan, EmptyPlanIsEmptyModel) { EXPECT_TRUE(ExtrudeFloorplan({}).faces.empty()); }

TEST(ExtrudeFloorplan, RefusesARoomWithoutHeight) {
  EXPECT_THROW((void)ExtrudeFloorplan(MakePlan({MakeRoom(0, kRectangle, {}, 2, 2)})),
               std::logic_error);
}

}  // namespace
}  // namespace enfilade
