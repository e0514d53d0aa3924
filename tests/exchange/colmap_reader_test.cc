// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A model as COLMAP writes it, little-endian.
class BinaryWriter {
 public:
  template <typename T>
  BinaryWriter& Put(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  BinaryWriter& Text(const std::string& text) {
    bytes_.append(text.c_str(), text.size() + 1);
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Upright cameras at (0, 0, 3) and (4, 0, 3) over 60 floor points at z = 0 and 20 on a wall.
struct TestModel {
  int model_id = 17;
  std::vector<double> params{16, 8};

  [[nodiscard]] std::string Cameras() const {
    BinaryWriter out;
    out.Put<uint64_t>(1).Put<uint32_t>(5).Put<int32_t>(model_id);
    out.Put<uint64_t>(16).Put<uint64_t>(8);
    for (const double param : params) out.Put(param);
    return out.bytes();
  }
  // cam_from_world of UprightRotation is a quarter turn about x; t = −R·centre.
  [[nodiscard]] std::string Images() const {
    BinaryWriter out;
    out.Put<uint64_t>(2);
    for (const uint32_t id : {3U, 9U}) {
      out.Put(id).Put(std::sqrt(0.5)).Put(std::sqrt(0.5)).Put(0.0).Put(0.0);
      out.Put(id == 3 ? 0.0 : -4.0).Put(3.0).Put(0.0).Put<uint32_t>(5);
      out.Text(id == 3 ? "a.png" : "b.png").Put<uint64_t>(2);
      for (int k = 0; k < 2; ++k) out.Put(1.0 + 4 * k).Put(2.0 + 2 * k).Put<uint64_t>(~uint64_t{0});
    }
    return out.bytes();
  }
  [[nodiscard]] std::string Points() const {
    BinaryWriter out;
    out.Put<uint64_t>(80);
    for (uint64_t i = 0; i < 80; ++i) {
      out.Put(i).Put(0.1 * static_cast<double>(i)).Put(1.0);
      out.Put(i < 60 ? 0.0 : 0.05 * static_cast<double>(i - 59));
      out.Put<uint8_t>(10).Put<uint8_t>(20).Put<uint8_t>(30).Put(0.5).Put<uint64_t>(3);
      out.Put<uint32_t>(9).Put<uint32_t>(1).Put<uint32_t>(3).Put<uint32_t>(0);
      out.Put<uint32_t>(9).Put<uint32_t>(0);
    }
    return out.bytes();
  }
};

class ColmapTest : public PoseFormatTest {
 protected:
  void Write(const TestModel& model, const fs::path& target) {
    WriteFileAtomic(target / "cameras.bin", model.Cameras());
    WriteFileAtomic(target / "images.bin", model.Images());
    WriteFileAtomic(target / "points3D.bin", model.Points());
  }
  void WriteText(const std::string& cameras, const std::string& images,
                 const std::string& points = "# none\n") {
    WriteFileAtomic(folder / "cameras.txt", cameras);
    WriteFileAtomic(folder / "images.txt", images);
    WriteFileAtomic(folder / "points3D.txt", points);
  }
  static void ExpectModel(const SceneReadReport& report) {
    EXPECT_EQ(report.scene.pose_source, PoseSource::kColmap);
    const View& view = ViewOf(report.scene, "b.png");
    EXPECT_TRUE(view.world_from_cam.rotation.isApprox(UprightRotation(), 1e-9));
    EXPECT_TRUE(view.world_from_cam.translation.isApprox(Eigen::Vector3d(4, 0, 3), 1e-9));
    ASSERT_FALSE(report.scene.points.empty());
    EXPECT_TRUE(report.scene.points[1].position.isApprox(Eigen::Vector3d(0.1, 1, 0), 1e-9));
    EXPECT_EQ(report.scene.points[1].rgb, (Eigen::Matrix<uint8_t, 3, 1>(10, 20, 30)));
    EXPECT_THAT(report.scene.points[1].view_idx, ElementsAre(0, 1));
    const size_t idx_of_b = view.sha256 == report.scene.views[1].sha256;
    ASSERT_EQ(report.scene.points[1].pixels.size(), 2U);
    // The first that the track names: the last 2D point of b.png, the first of a.png.
    EXPECT_EQ(report.scene.points[1].pixels[idx_of_b], Eigen::Vector2f(5, 4));
    EXPECT_EQ(report.scene.points[1].pixels[1 - idx_of_b], Eigen::Vector2f(1, 2));
  }
};

constexpr char kCamera[] = "# list\n5 EQUIRECTANGULAR 16 8 16 8\n";
constexpr char kImages[] =
    "# list\n3 0.70710678 0.70710678 0 0 0 3 0 5 a.png\n1 2 1 7 8 -1\n"
    "9 0.70710678 0.70710678 0 0 -4 3 0 5 b.png\n1 2 -1 5.0 4 2 \r\n";
constexpr char kPoints[] = "1 0 1 0 10 20 30 0.5 3 0\n2 0.1 1 0 10 20 30 0.5 9 1 3 0 9 0\n";

TEST_F(ColmapTest, ReadsABinaryModelInEachPlace) {
  for (const fs::path& place : {folder / "sparse" / "0", folder / "sparse", folder}) {
    Write({}, place);
    const SceneReadReport report = ReadTestScene(folder);
    EXPECT_EQ(report.pose_file, place);
    ExpectModel(report);
    EXPECT_EQ(report.scene.points.size(), 80U);
  }
}

TEST_F(ColmapTest, ReadsATextModel) {
  WriteText(kCamera, kImages, kPoints);
  ExpectModel(ReadTestScene(folder));
}

TEST_F(ColmapTest, IgnoresRigsAndFramesAndNeedsNoPoints) {
  Write({}, folder / "sparse");
  fs::remove(folder / "sparse" / "points3D.bin");
  WriteFileAtomic(folder / "sparse" / "rigs.bin", "x");
  WriteFileAtomic(folder / "sparse" / "frames.bin", "x");
  EXPECT_EQ(ReadTestScene(folder).scene.views.size(), 2U);
}

TEST_F(ColmapTest, ReadsPinholeModels) {
  Write({1, {20, 21, 8, 4}}, folder);
  const Camera camera = ViewOf(ReadTestScene(folder).scene, "a.png").camera;
  EXPECT_EQ(camera.model, CameraModel::kPinhole);
  EXPECT_EQ(camera.fy, 21);
  EXPECT_EQ(camera.cx, 8);
  Write({0, {20, 8, 4}}, folder);
  EXPECT_EQ(ViewOf(ReadTestScene(folder).scene, "a.png").camera.cy, 4);
}

TEST_F(ColmapTest, PixelsOfATrackAreUnknownWhereOneOfItIs) {
  WriteText(kCamera, kImages, "1 0 1 0 10 20 30 0.5 3 0 9 2\n2 0 1 0 10 20 30 0.5 3 1\n");
  const Scene scene = ReadTestScene(folder).scene;
  EXPECT_EQ(scene.points[0].view_idx.size(), 2U);
  EXPECT_THAT(scene.points[0].pixels, ElementsAre());
  EXPECT_THAT(scene.points[1].pixels, ElementsAre(Eigen::Vector2f(7, 8)));
}

// The pictures are half as large as the cameras, as those of undistorted models may be.
TEST_F(ColmapTest, PixelsAreThoseOfThePicture) {
  WriteText("5 PINHOLE 32 16 20 21 16 8\n", kImages, kPoints);
  const Scene scene = ReadTestScene(folder).scene;
  const size_t idx_of_a = ViewOf(scene, "a.png").sha256 == scene.views[1].sha256;
  EXPECT_EQ(scene.points[0].pixels.at(0), Eigen::Vector2f(0.5f, 1));
  EXPECT_EQ(scene.points[1].pixels.at(idx_of_a), Eigen::Vector2f(0.5f, 1));
}

TEST_F(ColmapTest, SaysThatTheUnitIsAssumed) {
  Write({}, folder);
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kAssumed);
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("metres are assumed; give --camera-height")));
}

TEST_F(ColmapTest, ScalesByTheCameraHeightOverTheFloorPoints) {
  Write({}, folder);
  SceneReadOptions options;
  options.camera_height_m = 1.5;
  const SceneReadReport report = ReadTestScene(folder, options);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kCameraHeight);
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("scaled by 0.5")));
  const View& view = ViewOf(report.scene, "b.png");
  EXPECT_TRUE(view.world_from_cam.translation.isApprox(Eigen::Vector3d(2, 0, 1.5), 1e-9));
  EXPECT_TRUE(report.scene.points[1].position.isApprox(Eigen::Vector3d(0.05, 0.5, 0), 1e-9));
}

TEST_F(ColmapTest, SaysWhenPointsAreTooFewToScale) {
  WriteText(kCamera, kImages, kPoints);
  SceneReadOptions options;
  options.camera_height_m = 1.5;
  const SceneReadReport report = ReadTestScene(folder, options);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kAssumed);
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("too few points")));
}

TEST_F(ColmapTest, RefusesOtherCameraModelsWithACure) {
  Write({4, {20, 20, 8, 4, 0.1, 0, 0, 0}}, folder);
  EXPECT_THAT(SceneRefusal(folder),
              AllOf(HasSubstr("model OPENCV"), HasSubstr("image_undistorter")));
  Write({99, {}}, folder);
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("model number 99"));
}

TEST_F(ColmapTest, RefusesTruncatedBinaryFiles) {
  const TestModel model;
  for (const auto& [name, whole] :
       {std::pair<std::string, std::string>{"cameras.bin", model.Cameras()},
        {"images.bin", model.Images()},
        {"points3D.bin", model.Points()}}) {
    Write(model, folder);
    for (size_t size = 0; size < std::min<size_t>(whole.size(), 200); size += 3) {
      WriteFileAtomic(folder / name, whole.substr(0, size));
      EXPECT_THAT(SceneRefusal(folder), AllOf(HasSubstr(name), HasSubstr("ends too early")))
          << size;
    }
    WriteFileAtomic(folder / name, whole + "x");
    EXPECT_THAT(SceneRefusal(folder), HasSubstr("goes on after its last entry"));
  }
}

TEST_F(ColmapTest, RefusesHugeCountsWithoutAllocatingForThem) {
  Write({}, folder);
  std::string images = TestModel().Images();
  const uint64_t huge = ~uint64_t{0} / 8;
  std::memcpy(images.data(), &huge, sizeof(huge));
  WriteFileAtomic(folder / "images.bin", images);
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("ends too early"));
}

TEST_F(ColmapTest, RefusesBrokenTextFiles) {
  const std::string image = "3 0.70710678 0.70710678 0 0 0 3 0 5 a.png\n\n";
  const auto refusal = [&](const std::string& cameras, const std::string& images,
                           const std::string& points = "") {
    WriteText(cameras, images, points);
    return SceneRefusal(folder);
  };
  EXPECT_EQ(refusal(kCamera, image), "");
  EXPECT_THAT(refusal(kCamera, ""), HasSubstr("has no poses"));
  EXPECT_THAT(refusal("", image), HasSubstr("a camera that is not there"));
  EXPECT_THAT(refusal("5 EQUIRECTANGULAR 16\n", image),
              HasSubstr("a camera cannot be read (line 1)"));
  EXPECT_THAT(refusal("5 CUBE 16 8\n", image), HasSubstr("camera model 'CUBE'"));
  EXPECT_THAT(refusal("5 PINHOLE 16 8 9 9\n", image), HasSubstr("a camera cannot be read"));
  EXPECT_THAT(refusal("5 PINHOLE 16 8 0 9 8 4\n", image), HasSubstr("focal length"));
  EXPECT_THAT(refusal("5 PINHOLE 0 8 9 9 8 4\n", image), HasSubstr("size"));
  EXPECT_THAT(refusal(kCamera, "3 1 0 0 0 0 0 0 5\n"),
              HasSubstr("an image cannot be read (line 1)"));
  EXPECT_THAT(refusal(kCamera, "3 nan 0 0 0 0 0 0 5 a.png\n"),
              HasSubstr("an image cannot be read"));
  EXPECT_THAT(refusal(kCamera, "3 2 0 0 0 0 0 0 5 a.png\n"), HasSubstr("no rotation"));
  EXPECT_THAT(refusal(kCamera, image + "3 1 0 0 0 0 0 0 5 b.png\n"),
              HasSubstr("two images with id 3"));
  EXPECT_THAT(refusal(kCamera, image, "1 0 0\n"), HasSubstr("a point cannot be read"));
  EXPECT_THAT(refusal(kCamera, image, "1 0 0 0 300 0 0 0\n"), HasSubstr("a point cannot be read"));
  EXPECT_THAT(refusal(kCamera, image, "1 0 0 0 3 0 0 0 3\n"), HasSubstr("a track cannot be read"));
  EXPECT_THAT(refusal(kCamera, image, "1 0 0 0 3 0 0 0 3 x\n"),
              HasSubstr("a track cannot be read"));
  const std::string image_line = image.substr(0, image.size() - 1);
  EXPECT_THAT(refusal(kCamera, image_line + "1 2\n"),
              HasSubstr("a 2D point of 'a.png' cannot be read (line 2)"));
  EXPECT_THAT(refusal(kCamera, image_line + "1 2 x\n"), HasSubstr("a 2D point of 'a.png'"));
  EXPECT_THAT(refusal(kCamera, image_line + "1 2 -1 x\n"), HasSubstr("a 2D point of 'a.png'"));
  EXPECT_THAT(refusal(kCamera, image_line + "1e300 2 1\n", "1 0 0 0 3 0 0 0 3 0\n"),
              HasSubstr("a 2D point is no pixel"));
}

}  // namespace
}  // namespace enfilade
