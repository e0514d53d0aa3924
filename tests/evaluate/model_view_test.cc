// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/model_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "enfilade/model/extrude.h"
#include "tests/evaluate/small_home.h"
#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

const AlignedBox3d kRoomBox(Vector3d(0, 0, 0), Vector3d(4, 3, 2.4));

Floorplan RoomPlan() { return MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3")}); }

// A level camera in the middle of the room that looks along +x.
Rigid3 LookAlongX() {
  Rigid3 home_from_cam;
  home_from_cam.rotation.col(0) = -Vector3d::UnitY();
  home_from_cam.rotation.col(1) = -Vector3d::UnitZ();
  home_from_cam.rotation.col(2) = Vector3d::UnitX();
  home_from_cam.translation = {2, 1.5, 1.2};
  return home_from_cam;
}

// Red far above blue: the floor's brown; walls, ceilings and the background are grey.
bool IsFloor(const ImageU8& image, int row, int col) {
  return image(row, col, 0) > image(row, col, 2) + 30;
}
bool IsDark(const ImageU8& image, int row, int col) { return image(row, col, 1) < 100; }

double ShareOf(const ImageU8& image, bool (*is_so)(const ImageU8&, int, int)) {
  int count = 0;
  for (int row = 0; row < image.rows(); ++row) {
    for (int col = 0; col < image.cols(); ++col) count += is_so(image, row, col);
  }
  return static_cast<double>(count) / (image.rows() * image.cols());
}

TEST(RenderFromOutside, LooksThroughTheCeilingOntoTheFloor) {
  RunContext context;
  const ImageU8 image = RenderFromOutside(ExtrudeFloorplan(RoomPlan()), kRoomBox, 200, context);
  EXPECT_EQ(image.cols(), 200);
  EXPECT_TRUE(IsFloor(image, image.rows() * 6 / 10, 100));
  for (const int corner : {0, 199}) {
    EXPECT_EQ(image(0, corner, 0), 255);
    EXPECT_EQ(image(0, corner, 2), 255);
  }
  // Some 12 m² of floor at a slant of 52°, less what nothing hides.
  EXPECT_GT(ShareOf(image, IsFloor), 0.25);
  EXPECT_LT(ShareOf(image, IsFloor), 0.6);
}

TEST(RenderFromOutside, HasNoSurfaceOfAModelThatTurnsItsBack) {
  RunContext context;
  BuildingModel model = ExtrudeFloorplan(RoomPlan());
  std::erase_if(model.faces, [](const ModelFace& f) { return f.kind != SurfaceKind::kCeiling; });
  const ImageU8 image = RenderFromOutside(model, kRoomBox, 60, context);
  EXPECT_TRUE(std::all_of(image.data().begin(), image.data().end(),
                          [](uint8_t value) { return value == 255; }));
}

TEST(RenderFromInside, ShowsFloorWallAndCeilingWhereTheyAre) {
  RunContext context;
  const Floorplan plan = RoomPlan();
  // 90° wide: the wall 2 m away is 1.2 m up and down, so 60 of 100 pixels.
  const Camera camera = PinholeCamera(100, 100, 50, 50, 50, 50);
  const ImageU8 image =
      RenderFromInside(ExtrudeFloorplan(plan), plan, LookAlongX(), camera, context);
  ASSERT_EQ(image.rows(), 100);
  EXPECT_FALSE(IsFloor(image, 77, 50));
  EXPECT_TRUE(IsFloor(image, 84, 50));
  EXPECT_FALSE(IsFloor(image, 16, 50));
  EXPECT_NE(image(15, 50, 0), image(50, 50, 0));  // ceiling and wall differ
  EXPECT_EQ(ShareOf(image, IsDark), 0);
}

TEST(RenderFromInside, ShowsDoorsShutAndOpeningsOpen) {
  RunContext context;
  Floorplan plan = RoomPlan();
  Opening door;
  door.a = {4, 1};
  door.b = {4, 2};
  door.head_z = 2;
  plan.storeys[0].openings = {door};
  const Camera camera = PinholeCamera(100, 100, 50, 50, 50, 50);
  const auto middle = [&] {
    const ImageU8 image =
        RenderFromInside(ExtrudeFloorplan(plan), plan, LookAlongX(), camera, context);
    EXPECT_FALSE(IsFloor(image, 50, 10));
    return std::array<int, 3>{image(50, 50, 0), image(50, 50, 1), image(50, 50, 2)};
  };
  const auto [red, green, blue] = middle();  // brown
  EXPECT_GT(red, green + 20);
  EXPECT_GT(green, blue + 20);
  plan.storeys[0].openings[0].kind = OpeningKind::kOpening;
  EXPECT_LT(middle()[0], 100);  // nothing behind
}

TEST(RenderFromInside, IsDarkWithoutSurface) {
  RunContext context;
  const Floorplan plan = RoomPlan();
  BuildingModel model = ExtrudeFloorplan(plan);
  std::erase_if(model.faces,
                [](const ModelFace& f) { return f.normal.dot(Vector3d::UnitX()) < -0.5; });
  const Camera camera = PinholeCamera(100, 100, 50, 50, 50, 50);
  const ImageU8 image = RenderFromInside(model, plan, LookAlongX(), camera, context);
  EXPECT_TRUE(IsDark(image, 50, 50));
  EXPECT_FALSE(IsDark(image, 90, 50));
}

TEST(RenderModel, SameBytesForAnyNumberOfThreads) {
  const Floorplan plan = RoomPlan();
  const BuildingModel model = ExtrudeFloorplan(plan);
  const Camera camera = PinholeCamera(80, 60, 40, 40, 40, 30);
  RunContext one(1), three(3);
  EXPECT_EQ(RenderFromOutside(model, kRoomBox, 80, one).data(),
            RenderFromOutside(model, kRoomBox, 80, three).data());
  EXPECT_EQ(RenderFromInside(model, plan, LookAlongX(), camera, one).data(),
            RenderFromInside(model, plan, LookAlongX(), camera, three).data());
}

TEST(ChooseInsideView, StandsWhereWallsAreFarAndLooksAlongTheRoom) {
  SmallHome home = MakeSmallHome();
  const InsideView inside = ChooseInsideView(home.scene, home.structure, 320);
  EXPECT_EQ(inside.camera.width, 320);
  EXPECT_EQ(inside.camera.height, 240);
  const Eigen::Matrix3d& rotation = inside.home_from_cam.rotation;
  EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
  EXPECT_NEAR((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  EXPECT_EQ(rotation(2, 1), -1);  // upright
  const View& view = home.scene.views[static_cast<size_t>(inside.view_idx)];
  EXPECT_NEAR((home.structure.home_from_world * view.world_from_cam.translation -
               inside.home_from_cam.translation)
                  .norm(),
              0, 1e-12);
  // One profile with a far corner: it is looked at.
  for (WallProfile& profile : home.structure.profiles)
    std::fill(profile.wall_m.begin(), profile.wall_m.end(), 1.0F);
  WallProfile& far = home.structure.profiles[1];
  for (int c = 0; c < far.num_columns(); ++c) {
    if (std::abs(AzimuthOfColumn(c, far.num_columns()) - 1) < 0.3)
      far.wall_m[static_cast<size_t>(c)] = 9;
  }
  far.wall_m[0] = std::numeric_limits<float>::quiet_NaN();
  std::fill(home.structure.profiles[0].wall_m.begin(), home.structure.profiles[0].wall_m.end(),
            0.5F);
  home.structure.profiles[2].wall_m = home.structure.profiles[0].wall_m;
  const InsideView turned = ChooseInsideView(home.scene, home.structure, 320);
  EXPECT_EQ(turned.view_idx, far.view_idx);
  const Vector3d forward = turned.home_from_cam.rotation.col(2);
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 1, 0.6);
}

}  // namespace
}  // namespace enfilade
