// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/scene_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

class SceneJsonTest : public testing::Test {
 protected:
  SceneJsonTest() {
    scene.pose_source = PoseSource::kColmap;
    scene.scale_source = ScaleSource::kAssumed;
    scene.camera_height_m = 1.1 + 1e-15;
    View panorama;
    panorama.picture = "a.jpg";
    panorama.path = temp / "in" / "a.jpg";
    panorama.sha256 = std::string(64, '1');
    panorama.camera = EquirectangularCamera(2048, 1024);
    panorama.world_from_cam = {RotationZ(0.1234567890123), Eigen::Vector3d(1.0 / 3, 2, 3)};
    panorama.storey_idx = 1;
    panorama.component_idx = 2;
    panorama.is_pose_inferred = true;
    View photo = panorama;
    photo.picture = "b.png";
    photo.path = temp / "in" / "50% \xFF" / "b.png";
    photo.camera = PinholeCamera(640, 480, 500.1, 499.9, 320, 239.5);
    photo.mask_path = temp / "masks" / "b.png";
    scene.views = {panorama, photo};
    ScenePoint point;
    point.position = {0.1, 0.2, 0.3};
    point.rgb = {255, 128, 0};
    point.view_idx = {0, 1};
    scene.points = {point, point};
    scene.points[1].pixels = {{0.1f, 1000.3f}, {-2, 1e-20f}};
  }

  std::string RefusalAfter(const std::function<void(Json&)>& change) {
    WriteSceneJson(file, scene);
    Json json = ReadJsonFile(file);
    change(json);
    WriteJsonFile(file, json);
    try {
      (void)ReadSceneJson(file);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }

  TempFolder temp;
  fs::path file = temp / "out" / "scene.json";
  Scene scene;
};

TEST_F(SceneJsonTest, ReadsBackExactlyWhatWasWritten) {
  WriteSceneJson(file, scene);
  const Scene read = ReadSceneJson(file);
  EXPECT_EQ(read.pose_source, scene.pose_source);
  EXPECT_EQ(read.scale_source, scene.scale_source);
  EXPECT_EQ(read.camera_height_m, scene.camera_height_m);
  ASSERT_EQ(read.views.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    const View &a = read.views[i], &b = scene.views[i];
    EXPECT_EQ(a.picture, b.picture);
    EXPECT_EQ(a.path, b.path);
    EXPECT_EQ(a.mask_path, b.mask_path);
    EXPECT_EQ(a.sha256, b.sha256);
    EXPECT_EQ(a.camera.model, b.camera.model);
    EXPECT_EQ(a.camera.width, b.camera.width);
    EXPECT_EQ(a.camera.fy, b.camera.fy);
    EXPECT_EQ(a.camera.cy, b.camera.cy);
    EXPECT_EQ(a.world_from_cam.Matrix(), b.world_from_cam.Matrix());
    EXPECT_EQ(a.storey_idx, b.storey_idx);
    EXPECT_EQ(a.component_idx, b.component_idx);
    EXPECT_EQ(a.is_pose_inferred, b.is_pose_inferred);
  }
  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points[0].position, scene.points[0].position);
  EXPECT_EQ(read.points[0].rgb, scene.points[0].rgb);
  EXPECT_EQ(read.points[0].view_idx, scene.points[0].view_idx);
  EXPECT_EQ(read.points[0].pixels, scene.points[0].pixels);
  EXPECT_EQ(read.points[1].pixels, scene.points[1].pixels);
}

TEST_F(SceneJsonTest, HoldsNoAbsolutePath) {
  WriteSceneJson(file, scene);
  EXPECT_THAT(ReadFile(file), testing::Not(HasSubstr(temp.path().native())));
}

TEST_F(SceneJsonTest, MovingPicturesAndResultTogetherKeepsTheirPaths) {
  WriteFileAtomic(temp / "home" / "in" / "a.jpg", "x");
  scene.views.resize(1);
  scene.points.clear();
  scene.views[0].path = temp / "home" / "in" / "a.jpg";
  WriteSceneJson(temp / "home" / "out" / "scene.json", scene);
  fs::rename(temp / "home", temp / "moved");
  const Scene read = ReadSceneJson(temp / "moved" / "out" / "scene.json");
  EXPECT_EQ(ReadFile(read.views[0].path), "x");
}

// Files of before pixels were kept have no such key.
TEST_F(SceneJsonTest, WritesNoKeyForUnknownPixels) {
  WriteSceneJson(file, scene);
  const Json points = ReadJsonFile(file)["points"];
  EXPECT_FALSE(points[0].contains("pixels"));
  EXPECT_EQ(points[1]["pixels"].size(), 4U);
}

TEST_F(SceneJsonTest, RefusesWrongContent) {
  using J = Json&;
  EXPECT_THAT(RefusalAfter([](J j) { j["format"] = 1; }), HasSubstr("'format' is number"));
  EXPECT_THAT(RefusalAfter([](J j) { j["version"] = 9; }), HasSubstr("this version"));
  EXPECT_THAT(RefusalAfter([](J j) { j["pose_source"] = "stars"; }), HasSubstr("make it one of"));
  EXPECT_THAT(RefusalAfter([](J j) { j["views"][0].erase("path"); }), HasSubstr("'path'"));
  EXPECT_THAT(RefusalAfter([](J j) { j["views"][0]["path"] = "100%"; }), HasSubstr("two digits"));
  EXPECT_THAT(RefusalAfter([](J j) { j["views"][0]["camera"]["width"] = 0; }), HasSubstr("size"));
  EXPECT_THAT(RefusalAfter([](J j) { j["views"][1]["camera"]["model"] = "fisheye"; }),
              HasSubstr("neither"));
  EXPECT_THAT(RefusalAfter([](J j) { j["views"][0]["world_from_cam"][0] = 5; }),
              HasSubstr("no rotation"));
  EXPECT_THAT(RefusalAfter([](J j) { j["views"][0]["storey"] = -1; }), HasSubstr("out of range"));
  EXPECT_THAT(RefusalAfter([](J j) { j["points"][0]["views"] = {5}; }), HasSubstr("not there"));
  EXPECT_THAT(RefusalAfter([](J j) { j["points"][1]["pixels"].erase(3); }),
              HasSubstr("as many pixels as views"));
  EXPECT_THAT(RefusalAfter([](J j) { j["points"][1]["pixels"][3] = "x"; }), HasSubstr("a pixel"));
  EXPECT_THAT(RefusalAfter([](J j) { j["points"][1]["pixels"][3] = 1e300; }),
              HasSubstr("a pixel is out of range"));
  EXPECT_THAT(RefusalAfter([](J j) { j["points"][1]["pixels"] = 5; }), HasSubstr("'pixels'"));
  EXPECT_THAT(RefusalAfter([](J j) {
                j["points"][0]["xyz"] = {1, 2};
              }),
              HasSubstr("three numbers"));
}

}  // namespace
}  // namespace enfilade
