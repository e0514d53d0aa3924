// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/colmap_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/colmap_model.h"
#include "src/exchange/pose_file.h"
#include "tests/exchange/box_scene.h"
#include "tests/exchange/rig_axis.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int kNumSlots = 10;
constexpr double kPoseTolerance = 1e-12;

// The scene without white space in the names, so that both encodings take it.
Scene PlainScene(const BoxSceneOptions& options = {}) {
  Scene scene = MakeBoxScene(options);
  for (View& view : scene.views) view.picture.erase(4, 1);
  return scene;
}

void ExpectPose(const Rigid3& pose, const Rigid3& expected) {
  EXPECT_LT((pose.Matrix() - expected.Matrix()).cwiseAbs().maxCoeff(), kPoseTolerance);
}

class ColmapWriterTest : public testing::TestWithParam<ColmapEncoding> {
 protected:
  TempFolder temp;
  fs::path folder = temp / "sparse";
};

INSTANTIATE_TEST_SUITE_P(Encodings, ColmapWriterTest,
                         testing::Values(ColmapEncoding::kText, ColmapEncoding::kBinary),
                         [](const auto& encoding) {
                           return encoding.param == ColmapEncoding::kText ? "Text" : "Binary";
                         });

TEST_P(ColmapWriterTest, PanoramasComeBackWithPosesPointsTracksAndPixels) {
  const Scene scene = PlainScene({.pixel_sigma = 1});
  WriteColmapModel(folder, scene, ColmapForm::kEquirectangular, GetParam());
  const PoseFile read = ReadColmapModel(folder);
  ASSERT_EQ(read.pictures.size(), scene.views.size());
  for (size_t i = 0; i < scene.views.size(); ++i) {
    EXPECT_EQ(read.pictures[i].name, scene.views[i].picture);
    EXPECT_EQ(read.pictures[i].camera.model, CameraModel::kEquirectangular);
    EXPECT_EQ(read.pictures[i].camera.width, 2048);
    EXPECT_EQ(read.pictures[i].camera.height, 1024);
    ExpectPose(read.pictures[i].world_from_cam, scene.views[i].world_from_cam);
  }
  ASSERT_EQ(read.points.size(), scene.points.size());
  for (size_t p = 0; p < scene.points.size(); ++p) {
    EXPECT_EQ(read.points[p].position, scene.points[p].position);
    EXPECT_EQ(read.points[p].rgb, scene.points[p].rgb);
    EXPECT_EQ(read.points[p].view_idx, scene.points[p].view_idx);
    EXPECT_EQ(read.points[p].pixels, scene.points[p].pixels);
  }
}

TEST_P(ColmapWriterTest, EveryObservationOfARigIsInTheViewWithTheNearestAxis) {
  const Scene scene = PlainScene();
  WriteColmapModel(folder, scene, ColmapForm::kPinholeRig, GetParam());
  const PoseFile read = ReadColmapModel(folder);
  ASSERT_EQ(read.pictures.size(), kNumSlots * scene.views.size());
  ASSERT_EQ(read.points.size(), scene.points.size());
  for (size_t p = 0; p < scene.points.size(); ++p) {
    const ScenePoint& point = read.points[p];
    ASSERT_EQ(point.view_idx.size(), scene.views.size());
    for (size_t k = 0; k < point.view_idx.size(); ++k) {
      const int slot = point.view_idx[k] % kNumSlots;
      EXPECT_EQ(point.view_idx[k] / kNumSlots, scene.points[p].view_idx[k]);
      const View& view = scene.views[static_cast<size_t>(scene.points[p].view_idx[k])];
      const Vector3d ray = (view.world_from_cam.Inverse() * point.position).normalized();
      for (int other = 0; other < kNumSlots; ++other) {
        EXPECT_LE(RigAxis(other).dot(ray), RigAxis(slot).dot(ray) + 1e-6);
      }
      // The camera that was written sees the point where the observation is, inside the picture.
      const PosedPicture& picture = read.pictures[static_cast<size_t>(point.view_idx[k])];
      const auto pixel =
          picture.camera.PixelFromRay(picture.world_from_cam.Inverse() * point.position);
      ASSERT_TRUE(pixel.has_value());
      EXPECT_LT((*pixel - point.pixels[k].cast<double>()).norm(), 2e-3);  // floats in 2048 pixels
    }
  }
}

TEST_P(ColmapWriterTest, ViewsOfARigHaveTheCentreOfTheirPanoramaAndItsSlot) {
  const Scene scene = PlainScene();
  WriteColmapModel(folder, scene, ColmapForm::kPinholeRig, GetParam());
  const PoseFile read = ReadColmapModel(folder);
  ASSERT_EQ(read.pictures.size(), kNumSlots * scene.views.size());
  for (size_t i = 0; i < read.pictures.size(); ++i) {
    const View& view = scene.views[i / kNumSlots];
    const int slot = static_cast<int>(i) % kNumSlots;
    const PosedPicture& picture = read.pictures[i];
    EXPECT_EQ(picture.name, "view_" + std::to_string(slot) + "/" + view.picture);
    EXPECT_LT((picture.world_from_cam.translation - view.world_from_cam.translation).norm(),
              kPoseTolerance);
    EXPECT_LT(
        (picture.world_from_cam.rotation.col(2) - view.world_from_cam.rotation * RigAxis(slot))
            .norm(),
        kPoseTolerance);
    if (slot < 8) {  // upright in the panorama
      EXPECT_LT(
          (picture.world_from_cam.rotation.col(1) - view.world_from_cam.rotation.col(1)).norm(),
          kPoseTolerance);
    }
    EXPECT_NEAR(picture.world_from_cam.rotation.determinant(), 1, kPoseTolerance);
    EXPECT_EQ(picture.camera.model, CameraModel::kPinhole);
    EXPECT_EQ(picture.camera.width, 652);  // 2 ⌈2048 / 2π⌉
    EXPECT_EQ(picture.camera.fx, 326);
  }
}

TEST_P(ColmapWriterTest, TellsTheMeanReprojectionError) {
  Scene scene = PlainScene();
  scene.points.resize(1);
  for (Eigen::Vector2f& pixel : scene.points[0].pixels) pixel.y() += 3;
  scene.points.push_back(scene.points[0]);
  scene.points[1].pixels.clear();
  WriteColmapModel(folder, scene, ColmapForm::kEquirectangular, GetParam());
  const ColmapModel model =
      GetParam() == ColmapEncoding::kText ? ReadColmapText(folder) : ReadColmapBinary(folder);
  EXPECT_NEAR(model.points[0].error_px, 3, 1e-3);
  EXPECT_EQ(model.points[1].error_px, -1);
}

TEST_P(ColmapWriterTest, ProjectsPointsWhosePixelsAreUnknown) {
  const Scene known = PlainScene();
  Scene scene = known;
  for (ScenePoint& point : scene.points) point.pixels.clear();
  WriteColmapModel(folder, scene, ColmapForm::kEquirectangular, GetParam());
  const PoseFile read = ReadColmapModel(folder);
  for (size_t p = 0; p < known.points.size(); ++p) {
    EXPECT_EQ(read.points[p].view_idx, known.points[p].view_idx);
    EXPECT_EQ(read.points[p].pixels, known.points[p].pixels);
  }
}

TEST_P(ColmapWriterTest, KeepsPinholePicturesInBothForms) {
  Scene scene = PlainScene();
  const Camera photo = PinholeCamera(640, 480, 500.25, 499.5, 320, 239.5);
  scene.views[1].camera = photo;
  scene.views[2].camera = photo;
  scene.views[2].camera.cy = 240;
  for (ScenePoint& point : scene.points) point.pixels.clear();
  for (const ColmapForm form : {ColmapForm::kEquirectangular, ColmapForm::kPinholeRig}) {
    const bool is_rig = form == ColmapForm::kPinholeRig;
    WriteColmapModel(folder, scene, form, GetParam());
    const PoseFile read = ReadColmapModel(folder);
    const size_t first = is_rig ? kNumSlots : 1;
    ASSERT_EQ(read.pictures.size(), 2 + 4 * first);
    EXPECT_EQ(read.pictures[first].name, is_rig ? "photos/pano1.jpg" : "pano1.jpg");
    EXPECT_EQ(read.pictures[first].camera.fx, 500.25);
    EXPECT_EQ(read.pictures[first].camera.cy, 239.5);
    EXPECT_EQ(read.pictures[first + 1].camera.cy, 240);
    ExpectPose(read.pictures[first].world_from_cam, scene.views[1].world_from_cam);
    for (const ScenePoint& point : read.points) {
      ASSERT_EQ(point.pixels.size(), point.view_idx.size());
      for (size_t k = 0; k < point.pixels.size(); ++k) {
        const Camera& camera = read.pictures[static_cast<size_t>(point.view_idx[k])].camera;
        EXPECT_GE(point.pixels[k].minCoeff(), 0);
        EXPECT_LE(point.pixels[k].x(), static_cast<float>(camera.width));
        EXPECT_LE(point.pixels[k].y(), static_cast<float>(camera.height));
      }
    }
  }
}

TEST_P(ColmapWriterTest, ReplacesAnotherModel) {
  for (const char* name : {"cameras.bin", "images.txt", "points3D.bin", "points3D.txt", "rigs.bin",
                           "rigs.txt", "frames.txt", "frames.bin"}) {
    WriteFileAtomic(folder / name, "old");
  }
  WriteColmapModel(folder, PlainScene(), ColmapForm::kPinholeRig, GetParam());
  WriteColmapModel(folder, PlainScene(), ColmapForm::kEquirectangular, GetParam());
  EXPECT_EQ(ReadColmapModel(folder).pictures.size(), 6U);
  size_t num_files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) num_files += entry.is_regular_file();
  EXPECT_EQ(num_files, 3U);
}

TEST_P(ColmapWriterTest, WritesTheSameBytesAgain) {
  for (const ColmapForm form : {ColmapForm::kEquirectangular, ColmapForm::kPinholeRig}) {
    WriteColmapModel(temp / "a", PlainScene(), form, GetParam());
    WriteColmapModel(temp / "b", PlainScene(), form, GetParam());
    for (const auto& entry : fs::directory_iterator(temp / "a")) {
      EXPECT_EQ(ReadFile(entry.path()), ReadFile(temp / "b" / entry.path().filename()));
    }
  }
}

TEST_P(ColmapWriterTest, WritesASceneWithoutPointsOrViews) {
  Scene scene = PlainScene();
  scene.points.clear();
  WriteColmapModel(folder, scene, ColmapForm::kPinholeRig, GetParam());
  EXPECT_EQ(ReadColmapModel(folder).pictures.size(), 60U);
  for (const ColmapForm form : {ColmapForm::kEquirectangular, ColmapForm::kPinholeRig}) {
    WriteColmapModel(folder, {}, form, GetParam());
    EXPECT_EQ(ReadColmapModel(folder).pictures.size(), 0U);
    EXPECT_FALSE(fs::exists(folder / "rig_config.json"));
  }
}

TEST_P(ColmapWriterTest, CallsPicturesByTheirPathBelowTheCommonFolder) {
  Scene scene = PlainScene();
  scene.views.resize(2);
  scene.points.clear();
  scene.views[0].path = temp / "tour" / "ground" / "." / "a.jpg";
  scene.views[1].path = temp / "tour" / "upstairs" / "a.jpg";
  WriteColmapModel(folder, scene, ColmapForm::kEquirectangular, GetParam());
  const PoseFile read = ReadColmapModel(folder);
  EXPECT_EQ(read.pictures[0].name, "ground/a.jpg");
  EXPECT_EQ(read.pictures[1].name, "upstairs/a.jpg");
}

TEST_P(ColmapWriterTest, SaysWhyItCannotWrite) {
  WriteFileAtomic(temp / "file", "x");
  EXPECT_THROW(WriteColmapModel(temp / "file", PlainScene(), ColmapForm::kPinholeRig, GetParam()),
               IoError);
  fs::create_directories(folder / "rigs.txt" / "full");
  EXPECT_THROW(WriteColmapModel(folder, PlainScene(), ColmapForm::kEquirectangular, GetParam()),
               IoError);
  EXPECT_THROW(WriteColmapModel("/proc/none", PlainScene(), ColmapForm::kPinholeRig, GetParam()),
               IoError);
}

TEST_P(ColmapWriterTest, RefusesScenesThatContradictThemselves) {
  Scene scene = PlainScene();
  scene.points[5].pixels.pop_back();
  EXPECT_THROW(WriteColmapModel(folder, scene, ColmapForm::kPinholeRig, GetParam()),
               std::logic_error);
  scene = PlainScene();
  scene.points[5].view_idx[0] = 6;
  EXPECT_THROW(WriteColmapModel(folder, scene, ColmapForm::kPinholeRig, GetParam()),
               std::logic_error);
  scene = PlainScene();
  scene.views[1].picture = scene.views[0].picture;
  EXPECT_THROW(WriteColmapModel(folder, scene, ColmapForm::kEquirectangular, GetParam()),
               std::logic_error);
}

TEST(ColmapWriter, KeepsSpacesInNamesInBinaryAndRefusesThemInText) {
  const TempFolder temp;
  const Scene scene = MakeBoxScene();
  WriteColmapModel(temp / "m", scene, ColmapForm::kEquirectangular, ColmapEncoding::kBinary);
  EXPECT_EQ(ReadColmapModel(temp / "m").pictures[2].name, "pano 2.jpg");
  try {
    WriteColmapModel(temp / "t", scene, ColmapForm::kEquirectangular, ColmapEncoding::kText);
    FAIL();
  } catch (const InvalidInputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("images.txt"), HasSubstr("'pano 0.jpg'"),
                                             HasSubstr("write the binary form")));
  }
  EXPECT_FALSE(fs::exists(temp / "t"));
}

}  // namespace
}  // namespace enfilade
