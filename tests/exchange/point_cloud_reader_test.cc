// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/point_cloud_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/colmap_writer.h"
#include "enfilade/exchange/ply_writer.h"
#include "enfilade/exchange/point_cloud_writer.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kAsciiHead[] =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 2\nproperty float x\nproperty float "
    "y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n";

void Write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

template <typename T>
std::string Bytes(std::initializer_list<T> values, bool is_big = false) {
  std::string bytes;
  for (const T value : values) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof(T));
    if (is_big) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  }
  return bytes;
}

std::vector<ScenePoint> ThreePoints() {
  std::vector<ScenePoint> points(3);
  points[0].position = {1, 2, 3.5};
  points[0].normal = {0, 0, 1};
  points[0].rgb = {1, 128, 255};
  points[0].view_idx = {0, 1};
  points[1].position = {-1.25, 0, 0.1f};
  points[1].normal = {0, -1, 0};
  points[1].view_idx = {1};
  points[2].position = {4, 5, 6};
  points[2].normal = {1, 0, 0};
  points[2].rgb = {9, 8, 7};
  return points;
}

void ExpectSame(const std::vector<ScenePoint>& points, const std::vector<ScenePoint>& expected) {
  ASSERT_EQ(points.size(), expected.size());
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].position, expected[i].position);
    EXPECT_EQ(points[i].normal, expected[i].normal);
    EXPECT_EQ(points[i].rgb, expected[i].rgb);
    EXPECT_EQ(points[i].view_idx, expected[i].view_idx);
  }
}

// A model of equirectangular pictures, in the world's axes but for the camera's.
Scene SceneOf(const std::vector<std::string>& pictures) {
  Scene scene;
  for (size_t i = 0; i < pictures.size(); ++i) {
    View view;
    view.picture = fs::path(pictures[i]).filename().native();
    view.path = "/home/" + pictures[i];
    view.camera = EquirectangularCamera(64, 32);
    view.world_from_cam.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    view.world_from_cam.translation = {static_cast<double>(i), 2, 1.5};
    scene.views.push_back(view);
  }
  return scene;
}

class PointCloudReaderTest : public testing::Test {
 protected:
  // fused.ply, fused.ply.vis and sparse/ with two images.
  void WriteFused(const std::vector<ScenePoint>& points) {
    WritePointsPly(folder / "fused.ply", points);
    WriteVisibility(folder / "fused.ply.vis", points);
    WriteColmapModel(folder / "sparse", SceneOf({"b.jpg", "a.jpg"}), ColmapForm::kEquirectangular,
                     ColmapEncoding::kBinary);
  }

  void WritePmvs(const std::vector<ScenePoint>& points) {
    WritePatches(folder / "models" / "option.patch", points);
    Write(folder / "bundle.rd.out.list.txt", "b.jpg\na.jpg\n");
  }

  void ExpectRefusal(const fs::path& path, const std::string& text, const fs::path& images = "") {
    try {
      (void)ReadPointCloud(path, images);
      ADD_FAILURE() << "not refused: " << text;
    } catch (const UserError& error) {
      EXPECT_THAT(error.what(), HasSubstr(text));
      EXPECT_THAT(std::string(error.what()), testing::Not(HasSubstr("\n")));
    }
  }

  void ExpectPlyRefusal(const std::string& bytes, const std::string& text) {
    Write(folder / "x.ply", bytes);
    ExpectRefusal(folder / "x.ply", text);
  }

  TempFolder temp;
  fs::path folder = temp / "cloud";
};

TEST_F(PointCloudReaderTest, AsciiPlyInAnyOrderWithMoreThanIsNeeded) {
  Write(folder / "x.ply",
        "ply\r\nformat ascii 1.0\r\nobj_info none\r\nelement camera 1\r\nproperty double f\r\n"
        "property list uchar int ids\r\nelement vertex 2\r\nproperty double nz\r\nproperty list "
        "uchar float weights\r\nproperty float64 x\r\nproperty float y\r\nproperty float32 z\r\n"
        "property float quality\r\nproperty float nx\r\nproperty float ny\r\nproperty ushort red"
        "\r\nproperty ushort green\r\nproperty ushort blue\r\nelement face 1\r\nproperty list "
        "uchar int vertex_indices\r\nend_header\r\n"
        "1e3 2 5 6\r\n2 0 1 2 3 0.5 0 0 0 257 65535\r\n"
        "0 2 1 1 -1 -2 -3 0.5 3 4 1 2 3\r\n3 0 1 0\r\n");
  const PointCloud cloud = ReadPointCloud(folder / "x.ply", "");
  EXPECT_FALSE(cloud.has_views);
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_EQ(cloud.points[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(cloud.points[0].normal, Eigen::Vector3d(0, 0, 1));  // made unit
  EXPECT_EQ(cloud.points[0].rgb, (Eigen::Matrix<uint8_t, 3, 1>(0, 1, 255)));
  EXPECT_LT((cloud.points[1].normal - Eigen::Vector3d(0.6, 0.8, 0)).norm(), 1e-15);
}

TEST_F(PointCloudReaderTest, BinaryPlyOfBothByteOrders) {
  for (const bool is_big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 1\nproperty double x\nproperty double "
                        "y\nproperty double z\nproperty float nx\nproperty float ny\nproperty "
                        "float nz\nproperty list uchar short more\nproperty float r\nproperty "
                        "float g\nproperty float b\nend_header\n";
    bytes += Bytes<double>({1, -2, 1e-3}, is_big) + Bytes<float>({0, 0, -1}, is_big) +
             Bytes<uint8_t>({2}) + Bytes<int16_t>({1, 2}, is_big) +
             Bytes<float>({0, 0.5f, 1}, is_big);
    Write(folder / "x.ply", bytes);
    const PointCloud cloud = ReadPointCloud(folder / "x.ply", "");
    ASSERT_EQ(cloud.points.size(), 1u);
    EXPECT_EQ(cloud.points[0].position, Eigen::Vector3d(1, -2, 1e-3));
    EXPECT_EQ(cloud.points[0].normal, Eigen::Vector3d(0, 0, -1));
    EXPECT_EQ(cloud.points[0].rgb, (Eigen::Matrix<uint8_t, 3, 1>(0, 128, 255)));
  }
}

TEST_F(PointCloudReaderTest, RefusesBrokenPly) {
  const std::string head = kAsciiHead, end = "end_header\n";
  ExpectRefusal(folder / "none.ply", "none.ply");
  ExpectPlyRefusal("", "is no PLY file");
  ExpectPlyRefusal("solid cube\n", "is no PLY file");
  ExpectPlyRefusal("ply\nformat ascii 1.0\n", "ends too early");
  ExpectPlyRefusal("ply\nformat ebcdic 1.0\n" + end, "format ebcdic 1.0");
  ExpectPlyRefusal("ply\nformat ascii 1.0\nelement vertex -1\n" + end, "element vertex -1");
  ExpectPlyRefusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n" + end, "half");
  ExpectPlyRefusal("ply\nformat ascii 1.0\nelement face 0\n" + end, "has no vertices");
  ExpectPlyRefusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty int nx\n" + end + "1\n",
                   "without x, y and z");
  ExpectPlyRefusal(head + end + "1 2 3 0 0 1\n", "too short");
  ExpectPlyRefusal(head + end + "1 2 3 0 0 1\n1.0000000 2 3 0 0\n", "ends too early");
  ExpectPlyRefusal(head + end + "1 2 3 0 0 1\n1 2 x 0 0 1\n", "'x' where a number");
  ExpectPlyRefusal(head + end + "1 2 3 0 0 1\n1 2 nan 0 0 1\n", "point 1 (from 0)");
  ExpectPlyRefusal(head + end + "1 2 3 0 0 inf\n1 2 3 0 0 1\n", "point 0 (from 0)");
  const size_t count = head.find("vertex 2");
  ExpectPlyRefusal(std::string(head).replace(count, 8, "vertex 99999999999999") + end + "1 2\n",
                   "too short");
  ExpectPlyRefusal(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
      "float z\n" +
          end + "1 2 3\n",
      "without normals");
}

TEST_F(PointCloudReaderTest, RefusesBinaryPlyThatIsCutOrPromisesTooMuch) {
  const std::string start = "ply\nformat binary_little_endian 1.0\n";
  const std::string vertex =
      "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float "
      "ny\nproperty float nz\n";
  const std::string row = Bytes<float>({1, 2, 3, 0, 0, 1});
  ExpectPlyRefusal(start + "element vertex 2\n" + vertex + "end_header\n" + row + row.substr(1),
                   "too short");
  ExpectPlyRefusal(start + "element vertex 1000000000000\n" + vertex + "end_header\n" + row,
                   "too short");
  const float nan = std::nanf("");
  ExpectPlyRefusal(
      start + "element vertex 1\n" + vertex + "end_header\n" + Bytes<float>({nan, 2, 3, 0, 0, 1}),
      "not finite");
  // A list that says it has four thousand million entries.
  ExpectPlyRefusal(start + "element vertex 1\n" + vertex +
                       "property list uint double w\nend_header\n" + row +
                       Bytes<uint32_t>({0xFFFFFFF0u}),
                   "ends too early");
}

TEST_F(PointCloudReaderTest, FusedPlyBringsWhoSeesIt) {
  const std::vector<ScenePoint> points = ThreePoints();
  WriteFused(points);
  const PointCloud cloud = ReadPointCloud(folder / "fused.ply", "");
  EXPECT_TRUE(cloud.has_views);
  ASSERT_EQ(cloud.images.size(), 2u);
  EXPECT_EQ(cloud.images[0].name, "b.jpg");
  EXPECT_EQ(cloud.images[1].name, "a.jpg");
  ASSERT_TRUE(cloud.images[1].position.has_value());
  EXPECT_LT((*cloud.images[1].position - Eigen::Vector3d(1, 2, 1.5)).norm(), 1e-12);
  ExpectSame(cloud.points, points);
}

TEST_F(PointCloudReaderTest, PatchesBringTheSame) {
  const std::vector<ScenePoint> points = ThreePoints();
  WritePmvs(points);
  WritePointsPly(folder / "models" / "option.ply", points);
  const PointCloud cloud = ReadPointCloud(folder / "models" / "option.patch", "");
  EXPECT_TRUE(cloud.has_views);
  EXPECT_EQ(cloud.images[1].name, "a.jpg");
  EXPECT_FALSE(cloud.images[1].position.has_value());
  ExpectSame(cloud.points, points);
  EXPECT_THAT(FilesOfCloud(folder / "models" / "option.patch", ""),
              ElementsAre(folder / "models" / "option.patch", folder / "models" / "option.ply",
                          folder / "bundle.rd.out.list.txt"));
}

TEST_F(PointCloudReaderTest, PatchesAsPmvsWritesThem) {
  Write(folder / "option.patch",
        "PATCHES\n1\nPATCHS\n2 4 6 2\n0 0 1 0\n0.95 0.002 0.1\n3\n7 2 7 \n2\n0 1 \n\n\n");
  Write(folder / "list.txt", "0.jpg\n1.jpg\n2.jpg\n3.jpg\n4.jpg\n5.jpg\n6.jpg\n7.jpg\r\n\n");
  const PointCloud cloud = ReadPointCloud(folder / "option.patch", "");
  ASSERT_EQ(cloud.points.size(), 1u);
  EXPECT_EQ(cloud.points[0].position, Eigen::Vector3d(1, 2, 3));  // homogeneous
  EXPECT_THAT(cloud.points[0].view_idx, ElementsAre(2, 7));       // those that agree, once each
  EXPECT_EQ(cloud.images.size(), 8u);
  Write(folder / "option.pset", "1 2 3 0 0 1\n4 5 6 0 2 0\n");
  const PointCloud pset = ReadPointCloud(folder / "option.pset", "");
  EXPECT_FALSE(pset.has_views);
  ASSERT_EQ(pset.points.size(), 2u);
  EXPECT_EQ(pset.points[1].normal, Eigen::Vector3d(0, 1, 0));
}

TEST_F(PointCloudReaderTest, RefusesBrokenVisibility) {
  WriteFused(ThreePoints());
  const fs::path ply = folder / "fused.ply", vis = folder / "fused.ply.vis";
  const std::string whole = ReadFile(vis);
  Write(vis, Bytes<uint64_t>({4}) + whole.substr(8));
  ExpectRefusal(ply, "is of 4 points, the cloud has 3");
  Write(vis, whole.substr(0, whole.size() - 1));
  ExpectRefusal(ply, "ends too early");
  Write(vis, "");
  ExpectRefusal(ply, "ends too early");
  Write(vis, whole + "x");
  ExpectRefusal(ply, "goes on");
  Write(vis, Bytes<uint64_t>({3}) + Bytes<uint32_t>({1, 2, 0, 0}));
  ExpectRefusal(ply, "point 0 (from 0) is seen by image 2, but");
  Write(vis, Bytes<uint64_t>({3}) + Bytes<uint32_t>({1, 0, 1, 0xFFFFFFFFu, 0}));
  ExpectRefusal(ply, "point 1 (from 0) is seen by image -1, but");
  Write(vis, Bytes<uint64_t>({3}) + Bytes<uint32_t>({0xFFFFFFFFu, 0, 0}));
  ExpectRefusal(ply, "ends too early");
}

TEST_F(PointCloudReaderTest, SaysWhichListIsMissing) {
  const std::vector<ScenePoint> points = ThreePoints();
  WriteFused(points);
  fs::remove_all(folder / "sparse");
  ExpectRefusal(folder / "fused.ply", "--points-images");
  ExpectRefusal(folder / "fused.ply", "does not exist", folder / "absent");
  ExpectRefusal(folder / "fused.ply", "holds no COLMAP model", folder);
  Write(folder / "names.txt", "\n\n");
  ExpectRefusal(folder / "fused.ply", "names no images", folder / "names.txt");
  Write(folder / "names.txt", "b.jpg\na.jpg\n");
  EXPECT_EQ(ReadPointCloud(folder / "fused.ply", folder / "names.txt").images.size(), 2u);
  WritePmvs(points);
  fs::remove(folder / "bundle.rd.out.list.txt");
  ExpectRefusal(folder / "models" / "option.patch", "--points-images");
}

TEST_F(PointCloudReaderTest, RefusesBrokenPatches) {
  WritePmvs(ThreePoints());
  const fs::path path = folder / "models" / "option.patch";
  const std::string whole = ReadFile(path);
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& text) {
    Write(path, std::string(whole).replace(whole.find(from), from.size(), to));
    ExpectRefusal(path, text);
  };
  expect("PATCHES", "PSET", "does not begin with PATCHES");
  expect("PATCHES\n3", "PATCHES\n2", "goes on after its last patch");
  expect("PATCHES\n3", "PATCHES\n3000000000", "too short");
  expect("PATCHES\n3", "PATCHES\n-1", "too short");
  expect("1 2 3.5 1", "1 2 nan 1", "point 0 (from 0)");
  expect("1 2 3.5 1", "1 2 3.5 0", "not finite");
  expect("\n2\n0 1", "\n2\n0 2", "is seen by image 2, but");
  expect("\n2\n0 1", "\n2\n0 -1", "names an image that cannot be");
  expect("\n2\n0 1", "\n99999\n0 1", "too short");
  Write(path, whole.substr(0, whole.size() / 2));
  ExpectRefusal(path, "");
  Write(folder / "x.pset", "1 2 3 0 0 1\n1 2 3 0 0\n");
  ExpectRefusal(folder / "x.pset", "point 1 (from 0)");
  Write(path, whole);
  std::vector<ScenePoint> fewer = ThreePoints();
  fewer.pop_back();
  WritePointsPly(folder / "models" / "option.ply", fewer);
  ExpectRefusal(path, "has 2 points, the patches are 3");
}

std::vector<int> ViewsOf(const std::vector<std::string>& names, const Scene& scene) {
  std::vector<CloudImage> images;
  for (const std::string& name : names) images.push_back({name, {}});
  return ViewsOfImages(images, scene);
}

TEST(ViewsOfImages, ByNameOfPictureOrOfItsParts) {
  const Scene scene = SceneOf({"home/living room.jpg", "home/hall.jpg", "attic/hall.jpg"});
  EXPECT_THAT(ViewsOf({"living room.jpg", "/x/home/hall.jpg", "attic/hall.jpg"}, scene),
              ElementsAre(0, 1, 2));
  // Two are called hall.jpg; other extensions; our own rig's names; PMVS's lists with focal
  // lengths.
  EXPECT_THAT(ViewsOf({"hall.jpg", "view_3/living_room.jpg", "pano_camera2/living room.png",
                       "attic/hall.jpg 0 812.5", "kitchen.jpg", ""},
                      scene),
              ElementsAre(-1, 0, 0, 2, -1, -1));
  EXPECT_THAT(ViewsOf({"view_0/hall_2.jpg", "view_9/hall.jpg"}, scene), ElementsAre(2, 1));
}

}  // namespace
}  // namespace enfilade
