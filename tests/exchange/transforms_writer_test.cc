// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/transforms_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"
#include "src/exchange/pose_file.h"
#include "tests/exchange/box_scene.h"
#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

TEST(TransformsWriter, PosesComeBack) {
  const TempFolder temp;
  const Scene scene = MakeBoxScene();
  WriteTransforms(temp / "transforms.json", scene);
  const PoseFile read = ReadTransforms(temp / "transforms.json");
  ASSERT_EQ(read.pictures.size(), scene.views.size());
  for (size_t i = 0; i < scene.views.size(); ++i) {
    EXPECT_EQ(read.pictures[i].name, scene.views[i].picture);
    EXPECT_EQ(read.pictures[i].camera.model, CameraModel::kEquirectangular);
    EXPECT_EQ(read.pictures[i].camera.width, 2048);
    EXPECT_LT((read.pictures[i].world_from_cam.Matrix() - scene.views[i].world_from_cam.Matrix())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-12);
  }
}

TEST(TransformsWriter, HasOneCameraForTheFileWhereAllAreTheSame) {
  const TempFolder temp;
  WriteTransforms(temp / "transforms.json", MakeBoxScene());
  const nlohmann::json json = ReadJsonFile(temp / "transforms.json");
  EXPECT_EQ(json["camera_model"], "EQUIRECTANGULAR");
  EXPECT_EQ(json["w"], 2048);
  EXPECT_EQ(json["h"], 1024);
  EXPECT_EQ(json["fl_x"], 1024.0);
  EXPECT_EQ(json["cy"], 512.0);
  EXPECT_FALSE(json["frames"][0].contains("w"));
}

TEST(TransformsWriter, HasCamerasPerFrameWhereTheyDiffer) {
  const TempFolder temp;
  Scene scene = MakeBoxScene();
  scene.views.resize(3);
  scene.views[1].camera = EquirectangularCamera(1024, 512);
  scene.views[2].camera = PinholeCamera(640, 480, 500.25, 499.5, 321, 239.5);
  WriteTransforms(temp / "transforms.json", scene);
  EXPECT_FALSE(ReadJsonFile(temp / "transforms.json").contains("camera_model"));
  const PoseFile read = ReadTransforms(temp / "transforms.json");
  EXPECT_EQ(read.pictures[0].camera.width, 2048);
  EXPECT_EQ(read.pictures[1].camera.model, CameraModel::kEquirectangular);
  EXPECT_EQ(read.pictures[1].camera.height, 512);
  const Camera& photo = read.pictures[2].camera;
  EXPECT_EQ(photo.model, CameraModel::kPinhole);
  EXPECT_EQ(photo.width, 640);
  EXPECT_EQ(photo.fx, 500.25);
  EXPECT_EQ(photo.fy, 499.5);
  EXPECT_EQ(photo.cx, 321);
  EXPECT_EQ(photo.cy, 239.5);
}

// An upright camera that looks along +y has OpenGL's axes x, z and −y.
TEST(TransformsWriter, WritesAxesOfOpenGl) {
  const TempFolder temp;
  Scene scene = MakeBoxScene();
  scene.views.resize(1);
  scene.views[0].world_from_cam = {UprightRotation(), {1, 2, 3}};
  WriteTransforms(temp / "transforms.json", scene);
  EXPECT_EQ(ReadJsonFile(temp / "transforms.json")["frames"][0]["transform_matrix"],
            UprightFrame("", 1, 2, 3)["transform_matrix"]);
}

TEST(TransformsWriter, TheSceneReaderReadsTheFileBesideThePictures) {
  const TempFolder temp;
  Scene scene = MakeBoxScene();
  scene.views.resize(2);
  for (int i = 0; i < 2; ++i) {
    View& view = scene.views[static_cast<size_t>(i)];
    view.path = temp / "tour" / "ground floor" / ("ü " + std::to_string(i) + ".png");
    view.picture = view.path.filename();
    view.camera = EquirectangularCamera(16, 8);
    WriteTestPicture(view.path, 10 * i);
  }
  scene.views[1].mask_path = temp / "tour" / "mask.png";
  WriteTestPicture(scene.views[1].mask_path, 255);
  WriteTransforms(temp / "tour" / "transforms.json", scene);
  EXPECT_EQ(ReadJsonFile(temp / "tour" / "transforms.json")["frames"][0]["file_path"],
            "ground floor/ü 0.png");
  const Scene read = ReadTestScene(temp / "tour").scene;
  ASSERT_EQ(read.views.size(), 2U);
  const View& view = ViewOf(read, "ü 1.png");
  EXPECT_LT((view.world_from_cam.Matrix() - scene.views[1].world_from_cam.Matrix()).norm(), 1e-12);
  EXPECT_EQ(view.mask_path.filename(), "mask.png");
}

TEST(TransformsWriter, WritesASceneWithoutViews) {
  const TempFolder temp;
  WriteTransforms(temp / "transforms.json", {});
  EXPECT_TRUE(ReadTransforms(temp / "transforms.json").pictures.empty());
}

TEST(TransformsWriter, SaysWhyItCannotWrite) {
  const TempFolder temp;
  WriteFileAtomic(temp / "file", "x");
  EXPECT_THROW(WriteTransforms(temp / "file" / "transforms.json", MakeBoxScene()), IoError);
  fs::create_directories(temp / "folder" / "full");
  EXPECT_THROW(WriteTransforms(temp / "folder", MakeBoxScene()), IoError);
}

}  // namespace
}  // namespace enfilade
