// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/write_home.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

Home SmallHome() {
  TextHomeOptions options;
  options.heading_rad = 0.35;
  options.floor_z = 0.15;
  return TextHome(
      "room 0,0 3,0 3,2.5 0,2.5 | room 3.1,0 5,0 5,2.5 3.1,2.5 | door 3,1 3,1.8 | window 1,0 2,0 | "
      "camera 1,1.2 | camera 2,1.4 | camera 4,1.2",
      options);
}

WriteHomeOptions Quick() {
  WriteHomeOptions options;
  options.width = 128;
  options.render.samples_per_pixel = 1;
  options.render.gather_rays = 16;
  options.render.bounces = 1;
  options.render.light_cell_m = 0.2;
  return options;
}

TEST(WriteHome, ReadersGetBackPosesAndPlan) {
  const TempFolder folder;
  const Home home = SmallHome();
  RunContext context;
  WriteHome(folder.path(), home, Quick(), context);

  const SceneReadReport report = ReadScene(folder.path(), {}, context);
  EXPECT_TRUE(report.warnings.empty());
  ASSERT_EQ(report.scene.views.size(), 3u);
  for (const View& view : report.scene.views) {
    EXPECT_EQ(view.camera.width, 128);
    for (size_t i = 0; i < home.cameras.size(); ++i) {
      if (home.cameras[i].picture != fs::path(view.picture).filename()) continue;
      const Rigid3 expected = home.WorldFromCamera(static_cast<int>(i));
      EXPECT_TRUE(view.world_from_cam.rotation.isApprox(expected.rotation, 1e-9));
      EXPECT_TRUE(view.world_from_cam.translation.isApprox(expected.translation, 1e-9));
    }
  }

  const Floorplan plan = ReadFloorplanJson(folder / "truth/floorplan.json");
  const Floorplan truth = TruthFloorplan(home);
  ASSERT_EQ(plan.storeys.size(), 1u);
  ASSERT_EQ(plan.storeys[0].rooms.size(), 2u);
  EXPECT_NEAR(Area(plan.storeys[0].rooms[0].polygon), 7.5, 1e-5);
  EXPECT_EQ(plan.storeys[0].walls.size(), truth.storeys[0].walls.size());
  EXPECT_EQ(plan.storeys[0].openings.size(), 2u);
  EXPECT_TRUE(plan.home_from_world.rotation.isApprox(home.home_from_world.rotation, 1e-6));
  EXPECT_NEAR(plan.storeys[0].floor_z, 0.15, 1e-6);
  for (const PlanCamera& camera : plan.cameras) EXPECT_EQ(camera.sha256.size(), 64u);
}

TEST(WriteHome, PoseFileHasTheClaimsAndTheTruthHasThePoses) {
  const TempFolder folder;
  Home home = SmallHome();
  Rigid3 claimed = home.cameras[1].home_from_cam;
  claimed.translation.x() += 0.05;
  home.cameras[1].claimed_home_from_cam = claimed;
  RunContext context;
  WriteHome(folder.path(), home, Quick(), context);
  const Scene scene = ReadScene(folder.path(), {}, context).scene;
  const auto view = std::find_if(scene.views.begin(), scene.views.end(), [&](const View& v) {
    return v.picture == home.cameras[1].picture;
  });
  ASSERT_NE(view, scene.views.end());
  const Floorplan truth = ReadFloorplanJson(folder / "truth/floorplan.json");
  const Eigen::Vector3d error =
      home.home_from_world.rotation *
      (view->world_from_cam.translation - truth.cameras[1].world_from_cam.translation);
  EXPECT_LT((error - Eigen::Vector3d(0.05, 0, 0)).norm(), 1e-5);
}

TEST(WriteHome, ReadersTakePerspectiveViews) {
  const TempFolder folder;
  const Home home = SmallHome();
  RunContext context;
  WriteHomeOptions options = Quick();
  WriteHome(folder.path(), home, options, context);
  options.kind = PictureKind::kPerspective;
  options.width = 256;
  WriteHome(folder.path(), home, options, context);
  EXPECT_FALSE(fs::exists(folder / "panos/pano_000.jpg"));

  const SceneReadReport report = ReadScene(folder.path(), {}, context);
  EXPECT_TRUE(report.warnings.empty());
  ASSERT_EQ(report.scene.views.size(), 24u);
  for (const View& view : report.scene.views) {
    EXPECT_EQ(view.camera.model, CameraModel::kPinhole);
    EXPECT_EQ(view.camera.width, 64);
    EXPECT_EQ(view.camera.height, 64);
    EXPECT_NEAR(view.camera.fx, 32, 1e-9);                          // 90°
    const auto place = static_cast<size_t>(view.picture[7] - '0');  // pano_00N_k.jpg
    const int k = view.picture[9] - '0';
    const Rigid3 pano = home.WorldFromCamera(static_cast<int>(place));
    EXPECT_TRUE(view.world_from_cam.translation.isApprox(pano.translation, 1e-9));
    // The views turn clockwise, seen from above, in steps of 45°.
    const Eigen::Vector3d forward = RotationZ(-kPi / 4 * k) * pano.rotation.col(2);
    EXPECT_TRUE(view.world_from_cam.rotation.col(2).isApprox(forward, 1e-9)) << view.picture;
  }
  EXPECT_EQ(ReadFloorplanJson(folder / "truth/floorplan.json").cameras.size(), 24u);
}

TEST(WriteHome, PixelTruthIsWrittenOnRequestOnly) {
  const TempFolder folder;
  RunContext context;
  WriteHomeOptions options = Quick();
  WriteHome(folder.path(), SmallHome(), options, context);
  EXPECT_FALSE(fs::exists(folder / "truth/depth"));
  options.has_pixel_truth = true;
  WriteHome(folder.path(), SmallHome(), options, context);
  EXPECT_EQ(fs::file_size(folder / "truth/depth/pano_001.npy"), 128u + 4u * 128 * 64);
  EXPECT_EQ(fs::file_size(folder / "truth/normals/pano_001.npy"), 128u + 3u * 128 * 64);
  EXPECT_EQ(fs::file_size(folder / "truth/rooms/pano_002.npy"), 128u + 2u * 128 * 64);
  EXPECT_TRUE(fs::exists(folder / "truth/walls/pano_000.npy"));
  const ImageU8 labels = ReadImageGray(folder / "truth/labels/pano_000.png");
  EXPECT_EQ(labels.cols(), 128);
  EXPECT_EQ(labels(4, 5), static_cast<uint8_t>(SurfaceLabel::kCeiling));
}

TEST(WriteHome, ReplacesAnEarlierHome) {
  const TempFolder folder;
  RunContext context;
  WriteHome(folder.path(), SmallHome(), Quick(), context);
  WriteFileAtomic(folder / "panos/own.txt", "kept");
  WriteHome(folder.path(), TextHome("room 0,0 3,0 3,2.5 0,2.5"), Quick(), context);
  EXPECT_TRUE(fs::exists(folder / "panos/pano_000.jpg"));
  EXPECT_FALSE(fs::exists(folder / "panos/pano_001.jpg"));
  EXPECT_TRUE(fs::exists(folder / "panos/own.txt"));
  EXPECT_EQ(ReadScene(folder.path(), {}, context).scene.views.size(), 1u);
}

TEST(WriteHome, SameHomeSameBytes) {
  const TempFolder a, b;
  RunContext one(1), two(2);
  WriteHome(a.path(), SmallHome(), Quick(), one);
  WriteHome(b.path(), SmallHome(), Quick(), two);
  for (const char* name : {"transforms.json", "truth/floorplan.json", "panos/pano_000.jpg"}) {
    EXPECT_EQ(ReadFile(a / name), ReadFile(b / name)) << name;
  }
}

TEST(WriteHome, ReadersTellStoreysApart) {
  const TempFolder folder;
  const Home home = MakeHome({.seed = 1, .rooms = 3, .storeys = 2, .furniture = 0});
  RunContext context(2);
  WriteHomeOptions options = Quick();
  options.width = 64;
  options.render.light_cell_m = 0.5;
  WriteHome(folder.path(), home, options, context);
  const Floorplan truth = ReadFloorplanJson(folder / "truth/floorplan.json");
  ASSERT_EQ(truth.storeys.size(), 2u);
  const Scene scene = ReadScene(folder.path(), {}, context).scene;
  ASSERT_EQ(scene.views.size(), home.cameras.size());
  for (const View& view : scene.views) {
    const auto camera = std::find_if(truth.cameras.begin(), truth.cameras.end(),
                                     [&](const PlanCamera& c) { return c.sha256 == view.sha256; });
    ASSERT_NE(camera, truth.cameras.end());
    EXPECT_EQ(view.storey_idx, camera->storey_idx);
  }
}

TEST(WriteHome, RefusesBadOptionsAndPlaces) {
  const TempFolder folder;
  RunContext context;
  WriteHomeOptions options = Quick();
  options.width = 129;
  EXPECT_THROW(WriteHome(folder.path(), SmallHome(), options, context), InvalidInputError);
  options.width = 8;
  EXPECT_THROW(WriteHome(folder.path(), SmallHome(), options, context), InvalidInputError);
  options.width = 100000;
  try {
    WriteHome(folder.path(), SmallHome(), options, context);
    FAIL() << "took 100000 pixels";
  } catch (const InvalidInputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("100000 pixels would take 240 GB of memory"));
  }
  RunContext capped(1, 0, 1000);
  options.width = 8192;  // 1.7 GB
  EXPECT_THROW(WriteHome(folder.path(), SmallHome(), options, capped), InvalidInputError);
  WriteFileAtomic(folder / "file", "x");
  EXPECT_THROW(WriteHome(folder / "file", SmallHome(), Quick(), context), IoError);
}

}  // namespace
}  // namespace enfilade
