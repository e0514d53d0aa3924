// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/scene_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/image/codec.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A small picture that differs by its seed.
void WritePicture(const fs::path& path, int seed, int width = 16, int height = 8) {
  ImageU8 image(height, width, 3, static_cast<uint8_t>(seed));
  WriteImage(path.parent_path() / (path.stem().native() + ".png"), image);
  if (path.extension() != ".png") {
    fs::rename(path.parent_path() / (path.stem().native() + ".png"), path);
  }
}

SceneReadReport Read(const fs::path& folder, const SceneReadOptions& options = {}) {
  RunContext context(2);
  return ReadScene(folder, options, context);
}

// The message of the refusal, "" when there is none.
std::string Refusal(const fs::path& folder, const SceneReadOptions& options = {}) {
  try {
    (void)Read(folder, options);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

Json IdentityFrame(const std::string& name, double x = 0, double z = 0) {
  return {{"file_path", name},
          {"transform_matrix", {{1, 0, 0, x}, {0, 0, -1, 0}, {0, 1, 0, z}, {0, 0, 0, 1}}}};
}

Json Transforms(const std::vector<Json>& frames) {
  return {{"camera_model", "EQUIRECTANGULAR"}, {"frames", frames}};
}

// Two panoramas 2 m apart.
class SceneReaderTest : public testing::Test {
 protected:
  void SetUp() override {
    WritePicture(folder / "images" / "a.png", 10);
    WritePicture(folder / "images" / "b.png", 20);
    WriteTransforms(Transforms({IdentityFrame("images/a.png"), IdentityFrame("images/b.png", 2)}));
  }
  void WriteTransforms(const Json& json) { WriteJsonFile(folder / "transforms.json", json); }

  TempFolder temp;
  fs::path folder = temp.path();
};

TEST_F(SceneReaderTest, ReadsTransforms) {
  const SceneReadReport report = Read(folder);
  EXPECT_THAT(report.warnings, testing::IsEmpty());
  ASSERT_EQ(report.scene.views.size(), 2U);
  EXPECT_EQ(report.num_pictures_found, 2);
  EXPECT_EQ(report.pose_file, folder / "transforms.json");
  const View& view = report.scene.views[report.scene.views[0].picture == "a.png" ? 1 : 0];
  EXPECT_EQ(view.picture, "b.png");
  EXPECT_EQ(view.camera.width, 16);
  EXPECT_EQ(view.camera.height, 8);
  EXPECT_EQ(view.world_from_cam.translation, Eigen::Vector3d(2, 0, 0));
  // Identity in OpenGL axes turned upright: the camera looks along +y, its right is +x.
  Eigen::Matrix3d expected;
  expected << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  EXPECT_TRUE(view.world_from_cam.rotation.isApprox(expected, 1e-12));
}

TEST_F(SceneReaderTest, RefusesWhatIsNoFolderOfPosedPictures) {
  EXPECT_THAT(Refusal(folder / "absent"), HasSubstr("cannot be listed"));
  EXPECT_THAT(Refusal(folder / "images"), HasSubstr("has no poses"));
  SceneReadOptions options;
  options.poses = "none";
  EXPECT_THAT(Refusal(folder, options), HasSubstr("from the pictures alone are not supported"));
}

}  // namespace
}  // namespace enfilade
