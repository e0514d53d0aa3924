// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/scene_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/exchange/posed_folder.h"
#include "tests/support/xmp_picture.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

// Two panoramas 2 m apart.
class SceneReaderTest : public testing::Test {
 protected:
  void SetUp() override {
    WriteTestPicture(folder / "images" / "a.png", 10);
    WriteTestPicture(folder / "images" / "b.png", 20);
    WriteFrames({UprightFrame("images/a.png"), UprightFrame("images/b.png", 2)});
  }
  void WriteFrames(const std::vector<Json>& frames) {
    WriteJsonFile(folder / "transforms.json", EquirectangularTransforms(frames));
  }

  TempFolder temp;
  fs::path folder = temp.path();
};

TEST_F(SceneReaderTest, ReadsPosedPictures) {
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_THAT(report.warnings, IsEmpty());
  ASSERT_EQ(report.scene.views.size(), 2U);
  EXPECT_EQ(report.num_pictures_found, 2);
  EXPECT_EQ(report.pose_file, folder / "transforms.json");
  EXPECT_EQ(report.scene.pose_source, PoseSource::kTransforms);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kPoses);
  EXPECT_EQ(report.scene.camera_height_m, std::nullopt);
  const View& view = ViewOf(report.scene, "b.png");
  EXPECT_EQ(view.path, folder / "images" / "b.png");
  EXPECT_EQ(view.camera.model, CameraModel::kEquirectangular);
  EXPECT_EQ(view.camera.width, 16);
  EXPECT_EQ(view.camera.height, 8);
  EXPECT_EQ(view.world_from_cam.translation, Eigen::Vector3d(2, 0, 0));
  EXPECT_TRUE(view.world_from_cam.rotation.isApprox(UprightRotation(), 1e-12));
}

TEST_F(SceneReaderTest, ViewsComeInTheOrderOfTheirHashes) {
  const Scene scene = ReadTestScene(folder).scene;
  EXPECT_LT(scene.views[0].sha256, scene.views[1].sha256);
}

TEST_F(SceneReaderTest, FindsPicturesWhereverTheyLie) {
  WriteTestPicture(folder / "far" / "c.png", 30);
  WriteTestPicture(folder / "panos" / "d.JPG", 40);
  WriteTestPicture(folder / "e.jpeg", 50);
  WriteFrames({UprightFrame("./images/a.png"), UprightFrame("elsewhere/b.png"),
               UprightFrame("far/c.png"), UprightFrame("d.JPG"), UprightFrame("gone/e.jpeg")});
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.views.size(), 5U);
  EXPECT_EQ(report.num_pictures_found, 5);
  EXPECT_EQ(ViewOf(report.scene, "c.png").path, folder / "far" / "c.png");
}

TEST_F(SceneReaderTest, LeavesOutPicturesWithoutPose) {
  for (int i = 0; i < 5; ++i) {
    WriteTestPicture(folder / "images" / ("x" + std::to_string(i) + ".png"), 100 + i);
  }
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.views.size(), 2U);
  EXPECT_EQ(report.num_unposed, 5);
  EXPECT_EQ(report.num_pictures_found, 7);
  EXPECT_THAT(report.warnings, ElementsAre(AllOf(HasSubstr("5 pictures have no pose"),
                                                 HasSubstr("x0.png, x1.png, x2.png and 2 more"))));
}

TEST_F(SceneReaderTest, KeepsOneOfPicturesThatAreTheSame) {
  WriteTestPicture(folder / "images" / "c.png", 10);
  WriteFrames({UprightFrame("images/a.png"), UprightFrame("images/b.png", 2),
               UprightFrame("images/c.png", 1)});
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.views.size(), 2U);
  EXPECT_EQ(report.num_duplicates, 1);
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("c.png is the same picture as a.png, though "
                                                     "posed 1.00 m away")));
}

TEST_F(SceneReaderTest, NamesThePicturesThatArePosedButAbsent) {
  WriteFrames({UprightFrame("images/a.png"), UprightFrame("p.png"), UprightFrame("q.png"),
               UprightFrame("r.png"), UprightFrame("s.png")});
  EXPECT_THAT(SceneRefusal(folder), AllOf(HasSubstr("transforms.json: 4 of 5 pictures"),
                                          HasSubstr("p.png, q.png, r.png and 1 more")));
}

TEST_F(SceneReaderTest, RefusesTwoPosesForOnePicture) {
  WriteFrames({UprightFrame("images/a.png"), UprightFrame("images/a.png", 1)});
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("names 'images/a.png' twice"));
  WriteFrames({UprightFrame("images/a.png"), UprightFrame("a.png", 1)});
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("are the same picture"));
}

TEST_F(SceneReaderTest, RefusesAPanoramaThatIsNotTwiceAsWideAsHigh) {
  WriteTestPicture(folder / "images" / "b.png", 20, 16, 9);
  EXPECT_THAT(SceneRefusal(folder), AllOf(HasSubstr("b.png"), HasSubstr("16 x 9 pixels")));
}

TEST_F(SceneReaderTest, RefusesPicturesThatAreNone) {
  const fs::path picture = folder / "images" / "b.png";
  const std::string whole = ReadFile(picture);
  for (const std::string& bytes : {std::string(), std::string("text"), whole.substr(0, 12)}) {
    WriteFileAtomic(picture, bytes);
    EXPECT_THAT(SceneRefusal(folder), HasSubstr("b.png")) << bytes.size();
  }
}

TEST_F(SceneReaderTest, RefusesANameThatIsNoUtf8) {
  WriteTestPicture(folder / "images" / "caf\xE9.png", 30);
  WriteFileAtomic(folder / "poses.csv", "file,x,y,z,qw,qx,qy,qz\ncaf\xE9.png,0,0,0,1,0,0,0\n");
  SceneReadOptions options;
  options.poses = folder / "poses.csv";
  EXPECT_THAT(SceneRefusal(folder, options), AllOf(HasSubstr("caf\\xe9.png"), HasSubstr("UTF-8")));
}

TEST_F(SceneReaderTest, RefusesWhatIsNoFolderOfPosedPictures) {
  EXPECT_THAT(SceneRefusal(folder / "absent"), HasSubstr("cannot be listed"));
  WriteFrames({});
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("has no poses"));
}

TEST_F(SceneReaderTest, ReadsPicturesAlone) {
  SceneReadOptions options;
  options.poses = "none";
  options.camera_height_m = 1.4;
  fs::copy_file(folder / "images" / "a.png", folder / "images" / "copy.png");
  const SceneReadReport report = ReadTestScene(folder, options);
  ASSERT_EQ(report.scene.views.size(), 2U);
  EXPECT_EQ(report.scene.pose_source, PoseSource::kEstimated);
  EXPECT_EQ(report.scene.camera_height_m, 1.4);
  EXPECT_LT(report.scene.views[0].sha256, report.scene.views[1].sha256);
  EXPECT_EQ(report.num_duplicates, 1);
  EXPECT_EQ(report.num_pictures_found, 3);
  // Where there are no poses beside the pictures it is the same.
  EXPECT_EQ(ReadTestScene(folder / "images").scene.pose_source, PoseSource::kEstimated);
}

TEST_F(SceneReaderTest, LeavesOutWhatIsNoWholePanorama) {
  WriteTestPicture(folder / "images" / "preview.png", 30, 16, 12);
  SceneReadOptions options;
  options.poses = "none";
  const SceneReadReport report = ReadTestScene(folder, options);
  EXPECT_EQ(report.scene.views.size(), 2U);
  EXPECT_THAT(report.warnings, ElementsAre(AllOf(HasSubstr("preview.png is 16 x 12 pixels"),
                                                 HasSubstr("left out"))));
  fs::remove(folder / "images" / "a.png");
  fs::remove(folder / "images" / "b.png");
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("has no whole panoramas"));
  fs::remove(folder / "images" / "preview.png");
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("has no pictures"));
}

TEST_F(SceneReaderTest, LeavesOutPartsOfPanoramas) {
  const std::string png = ReadFile(folder / "images" / "a.png");
  WriteFileAtomic(
      folder / "images" / "part.png",
      PngWithXmp(png,
                 GPanoPacket(R"(GPano:FullPanoWidthPixels="64" GPano:FullPanoHeightPixels="32")"
                             R"( GPano:CroppedAreaImageWidthPixels="16")"
                             R"( GPano:CroppedAreaImageHeightPixels="8")")));
  SceneReadOptions options;
  options.poses = "none";
  const SceneReadReport report = ReadTestScene(folder, options);
  EXPECT_EQ(report.scene.views.size(), 2U);
  EXPECT_THAT(report.warnings,
              ElementsAre(AllOf(HasSubstr("part.png is a part of a panorama of 64 x 32 pixels"),
                                HasSubstr("left out"))));
  // With a pose it would put everything in wrong places.
  WriteFrames({UprightFrame("images/a.png"), UprightFrame("images/part.png", 2)});
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("part.png: is a part of a panorama"));
}

TEST_F(SceneReaderTest, KeepsTheVerticalThatMetadataTell) {
  const std::string png = ReadFile(folder / "images" / "a.png");
  WriteFileAtomic(folder / "images" / "a.png",
                  PngWithXmp(png, GPanoPacket(R"(GPano:PoseRollDegrees="180")")));
  WriteFileAtomic(folder / "images" / "broken.png", PngWithXmp(png, "<x:xmpmeta PoseRoll"));
  SceneReadOptions options;
  options.poses = "none";
  const SceneReadReport report = ReadTestScene(folder, options);
  EXPECT_THAT(report.warnings, IsEmpty());
  ASSERT_TRUE(ViewOf(report.scene, "a.png").told_up_in_cam);
  EXPECT_TRUE(ViewOf(report.scene, "a.png").told_up_in_cam->isApprox(Eigen::Vector3d(0, 1, 0)));
  EXPECT_FALSE(ViewOf(report.scene, "b.png").told_up_in_cam);
  EXPECT_FALSE(ViewOf(report.scene, "broken.png").told_up_in_cam);
}

TEST_F(SceneReaderTest, TakesTheFirstPoseSourceUnlessToldOtherwise) {
  WriteFileAtomic(folder / "poses.csv", "file,x,y,z,qw,qx,qy,qz\na.png,7,0,0,1,0,0,0\n");
  EXPECT_EQ(ReadTestScene(folder).scene.pose_source, PoseSource::kTransforms);
  SceneReadOptions options;
  options.poses = folder / "poses.csv";
  const SceneReadReport report = ReadTestScene(folder, options);
  EXPECT_EQ(report.scene.pose_source, PoseSource::kCsv);
  EXPECT_EQ(report.num_unposed, 1);
}

TEST_F(SceneReaderTest, RefusesAPoseFileOfNoKnownKind) {
  SceneReadOptions options;
  options.poses = folder / "poses.xyz";
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("does not exist"));
  WriteFileAtomic(folder / "poses.xyz", "1 2 3");
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("no known pose file"));
  options.poses = folder / "images";
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("holds no COLMAP model"));
  options.poses = folder / "other.json";
  for (const char* text : {"{}", "[]", "3"}) {
    WriteFileAtomic(folder / "other.json", text);
    EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("no known pose file")) << text;
  }
}

TEST_F(SceneReaderTest, RefusesPositionsInAnotherUnit) {
  WriteFrames({UprightFrame("images/a.png"), UprightFrame("images/b.png", 20000)});
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("more than 10 km"));
}

TEST_F(SceneReaderTest, TellsStoreysApartByGapsBetweenCameraHeights) {
  WriteTestPicture(folder / "images" / "c.png", 30);
  WriteFrames({UprightFrame("images/a.png", 0, 0, 4.3), UprightFrame("images/b.png", 2, 0, 0.8),
               UprightFrame("images/c.png", 4, 0, 1.9)});
  const Scene scene = ReadTestScene(folder).scene;
  EXPECT_EQ(ViewOf(scene, "a.png").storey_idx, 1);
  EXPECT_EQ(ViewOf(scene, "b.png").storey_idx, 0);
  EXPECT_EQ(ViewOf(scene, "c.png").storey_idx, 0);
}

TEST_F(SceneReaderTest, TurnsAWorldWithAnotherAxisUp) {
  // The same cameras in a world whose y points up: (x, y, z) is (x, z, −y) of ours.
  Json frame_a = UprightFrame("images/a.png"), frame_b = UprightFrame("images/b.png");
  frame_a["transform_matrix"] = {{1, 0, 0, 0}, {0, 1, 0, 1.5}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  frame_b["transform_matrix"] = {{1, 0, 0, 2}, {0, 1, 0, 1.5}, {0, 0, 1, -3}, {0, 0, 0, 1}};
  WriteFrames({frame_a, frame_b});
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("the world is turned")));
  const View& view = ViewOf(report.scene, "b.png");
  EXPECT_TRUE(view.world_from_cam.translation.isApprox(Eigen::Vector3d(2, 3, 1.5), 1e-12));
  EXPECT_TRUE(view.world_from_cam.rotation.isApprox(UprightRotation(), 1e-12));
}

TEST_F(SceneReaderTest, AGivenCameraHeightIsAPriorWherePosesHaveAScale) {
  SceneReadOptions options;
  options.camera_height_m = 1.7;
  const Scene scene = ReadTestScene(folder, options).scene;
  EXPECT_EQ(scene.camera_height_m, 1.7);
  EXPECT_EQ(scene.scale_source, ScaleSource::kPoses);
  EXPECT_EQ(ViewOf(scene, "b.png").world_from_cam.translation.x(), 2);
}

TEST_F(SceneReaderTest, AttachesMasks) {
  WriteTestPicture(folder / "masks" / "a.png", 0);
  SceneReadOptions options;
  options.mask = folder / "masks";
  Scene scene = ReadTestScene(folder, options).scene;
  EXPECT_EQ(ViewOf(scene, "a.png").mask_path, folder / "masks" / "a.png");
  EXPECT_TRUE(ViewOf(scene, "b.png").mask_path.empty());
  options.mask = folder / "masks" / "a.png";
  scene = ReadTestScene(folder, options).scene;
  EXPECT_EQ(ViewOf(scene, "b.png").mask_path, folder / "masks" / "a.png");
  WriteTestPicture(folder / "masks" / "a.png", 0, 8, 4);
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("8 x 4 pixels"));
  options.mask = folder / "images" / "..";
  EXPECT_THAT(SceneRefusal(folder, options), HasSubstr("no mask with the name of a picture"));
}

TEST_F(SceneReaderTest, RefusesFilesThatMayNotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  fs::permissions(folder / "images" / "b.png", fs::perms::none);
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("check the permissions"));
}

TEST_F(SceneReaderTest, OptionsHaveTheirNamesInTheVisit) {
  SceneReadOptions options;
  std::vector<std::string> names;
  for (const OptionInfo& info : ListOptions(VisitorOf(options))) names.push_back(info.path);
  EXPECT_THAT(names, ElementsAre("poses", "camera_height_m", "mask"));
}

}  // namespace
}  // namespace enfilade
