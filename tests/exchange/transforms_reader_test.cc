// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class TransformsTest : public PoseFormatTest {
 protected:
  void SetUp() override {
    PoseFormatTest::SetUp();
    json =
        EquirectangularTransforms({UprightFrame("images/a.png"), UprightFrame("images/b.png", 2)});
  }
  std::string RefusalAfter(const std::function<void(Json&)>& change) {
    Json changed = json;
    change(changed);
    WriteJsonFile(folder / "transforms.json", changed);
    return SceneRefusal(folder);
  }

  Json json;
};

TEST_F(TransformsTest, ReadsPinholePictures) {
  json.erase("camera_model");
  json.update({{"fl_x", 20.0}, {"cx", 8.5}, {"w", 32}, {"h", 16}, {"k1", 0.0}});
  json["frames"][1].update({{"fl_x", 10.0}, {"fl_y", 11.0}, {"w", 16}, {"h", 8}, {"cy", 3.0}});
  WriteJsonFile(folder / "transforms.json", json);
  const Scene scene = ReadTestScene(folder).scene;
  const Camera& halved = ViewOf(scene, "a.png").camera;  // the picture is half the camera's size
  EXPECT_EQ(halved.model, CameraModel::kPinhole);
  EXPECT_EQ(halved.fx, 10);
  EXPECT_EQ(halved.fy, 10);
  EXPECT_EQ(halved.cx, 4.25);
  EXPECT_EQ(halved.cy, 4);
  const Camera& own = ViewOf(scene, "b.png").camera;
  EXPECT_EQ(own.fx, 10);
  EXPECT_EQ(own.fy, 11);
  EXPECT_EQ(own.cy, 3);
}

TEST_F(TransformsTest, RepairsRoundedRotations) {
  json["frames"][0]["transform_matrix"][0][0] = 0.9995;
  WriteJsonFile(folder / "transforms.json", json);
  const Scene scene = ReadTestScene(folder).scene;
  const Eigen::Matrix3d r = ViewOf(scene, "a.png").world_from_cam.rotation;
  EXPECT_TRUE((r.transpose() * r).isIdentity(1e-12));
}

TEST_F(TransformsTest, ReadsTheMasksThatFramesName) {
  WriteTestPicture(folder / "masks" / "a.png", 0);
  json["frames"][0]["mask_path"] = "masks/a.png";
  WriteJsonFile(folder / "transforms.json", json);
  EXPECT_EQ(ViewOf(ReadTestScene(folder).scene, "a.png").mask_path, folder / "masks" / "a.png");
  EXPECT_THAT(RefusalAfter([](Json& j) { j["frames"][0]["mask_path"] = "gone.png"; }),
              HasSubstr("'gone.png' that it names is absent"));
}

TEST_F(TransformsTest, RefusesBrokenFiles) {
  const std::string whole = json.dump();
  for (size_t size = 0; size < whole.size(); size += 37) {
    WriteFileAtomic(folder / "transforms.json", whole.substr(0, size));
    EXPECT_THAT(SceneRefusal(folder), HasSubstr("no valid JSON")) << size;
  }
  WriteFileAtomic(folder / "transforms.json", "\xFF\xFE{}");
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("no valid JSON"));
  std::string nan = whole;
  nan.replace(nan.find("2.0"), 3, "NaN");
  WriteFileAtomic(folder / "transforms.json", nan);
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("no valid JSON"));
  fs::remove(folder / "transforms.json");
  fs::create_directory(folder / "transforms.json");
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("not a regular file"));
}

TEST_F(TransformsTest, RefusesWrongContent) {
  using J = Json&;
  EXPECT_THAT(RefusalAfter([](J j) { j = Json::array(); }), HasSubstr("'frames' is missing"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"] = 3; }), HasSubstr("'frames' is number"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0] = 3; }), HasSubstr("'file_path' is missing"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0].erase("transform_matrix"); }),
              HasSubstr("'transform_matrix' is missing"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0]["transform_matrix"].erase(3); }),
              AllOf(HasSubstr("images/a.png"), HasSubstr("4 × 4")));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0]["transform_matrix"][1][1] = "x"; }),
              HasSubstr("not a number"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0]["transform_matrix"][0][0] = 2; }),
              HasSubstr("no rotation"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0]["transform_matrix"][0][0] = -1; }),
              HasSubstr("mirrors"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0]["transform_matrix"][3][0] = 1; }),
              HasSubstr("last row"));
  EXPECT_THAT(RefusalAfter([](J j) { j["frames"][0]["transform_matrix"][0][3] = 1e300; }),
              HasSubstr("10 km"));
  EXPECT_THAT(RefusalAfter([](J j) { j["camera_model"] = "OPENCV_FISHEYE"; }),
              HasSubstr("'OPENCV_FISHEYE' is not supported"));
  EXPECT_THAT(RefusalAfter([](J j) { j.erase("camera_model"); }), HasSubstr("fl_x"));
  const auto pinhole = [](J j, double k1) {
    j.erase("camera_model");
    j.update({{"fl_x", 20.0}, {"w", 16}, {"h", 8}, {"k1", k1}});
  };
  EXPECT_THAT(RefusalAfter([&](J j) { pinhole(j, 0.1); }), HasSubstr("undistort"));
  EXPECT_THAT(RefusalAfter([&](J j) { pinhole(j, 0), j["h"] = 12; }), HasSubstr("16 x 12"));
  EXPECT_THAT(RefusalAfter([&](J j) { pinhole(j, 0), j.erase("w"); }), HasSubstr("keys w and h"));
  EXPECT_THAT(RefusalAfter([&](J j) { pinhole(j, 0), j["w"] = 1.5; }), HasSubstr("picture size"));
}

}  // namespace
}  // namespace enfilade
