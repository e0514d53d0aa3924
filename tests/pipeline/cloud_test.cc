// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>

#include "enfilade/base/errors.h"
#include "enfilade/exchange/colmap_writer.h"
#include "enfilade/exchange/ply_writer.h"
#include "enfilade/exchange/point_cloud_writer.h"
#include "tests/pipeline/damage.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::HasSubstr;

Scene SceneOfFour() {
  Scene scene;
  const std::vector<Vector3d> places = {
      {1, 1, 1.4}, {5, 1.2, 1.5}, {4.8, 4, 1.4}, {1.5, 3.5, 1.45}};
  for (size_t i = 0; i < places.size(); ++i) {
    View view;
    view.picture = "pano_" + std::to_string(i) + ".jpg";
    view.camera = EquirectangularCamera(64, 32);
    view.world_from_cam.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    view.world_from_cam.translation = places[i];
    scene.views.push_back(view);
  }
  return scene;
}

// The inside of a room of 6 × 5 × 2.5 m, a point every 10 cm, seen by all.
std::vector<ScenePoint> RoomPoints(const Scene& scene) {
  constexpr double kStep = 0.1;
  const Vector3d size(6, 5, 2.5);
  std::vector<ScenePoint> points;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double a = kStep / 2; a < size[u]; a += kStep) {
      for (double b = kStep / 2; b < size[v]; b += kStep) {
        for (const int side : {0, 1}) {
          ScenePoint point;
          point.position[axis] = side * size[axis];
          point.position[u] = a;
          point.position[v] = b;
          point.normal[axis] = side == 0 ? 1 : -1;
          point.rgb = {static_cast<uint8_t>(axis), 200, 3};
          for (size_t i = 0; i < scene.views.size(); ++i)
            point.view_idx.push_back(static_cast<int>(i));
          points.push_back(point);
        }
      }
    }
  }
  return points;
}

void Move(const Eigen::Affine3d& transform, std::vector<ScenePoint>& points) {
  for (ScenePoint& point : points) {
    point.position = transform * point.position;
    point.normal = (transform.linear() * point.normal).normalized();
  }
}

class ReadCloudTest : public testing::Test {
 protected:
  void WritePly() { WritePointsPly(options.file, points); }

  void ExpectRefusal(const std::string& problem, const std::string& cure) {
    try {
      (void)ReadCloud(options, scene, context);
      ADD_FAILURE() << "not refused: " << problem;
    } catch (const InvalidInputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(options.file));
      EXPECT_THAT(error.what(), HasSubstr(problem));
      EXPECT_THAT(error.what(), HasSubstr(cure));
    }
  }

  TempFolder temp;
  Scene scene = SceneOfFour();
  std::vector<ScenePoint> points = RoomPoints(scene);
  CloudOptions options{.file = (temp / "fused.ply").native(), .images = ""};
  RunContext context{2};
};

TEST_F(ReadCloudTest, CastsRaysWhereNothingTellsWhoSees) {
  WritePly();
  const std::vector<ScenePoint> read = ReadCloud(options, scene, context);
  // One empty room: everybody sees everything, but for a few points in its edges.
  EXPECT_GT(read.size(), points.size() * 99 / 100);
  size_t num_sights = 0;
  for (const ScenePoint& point : read) num_sights += point.view_idx.size();
  EXPECT_GT(num_sights, 4 * points.size() * 95 / 100);
}

TEST_F(ReadCloudTest, NamesTheAxisAndTheUnitWithWhichItWouldFit) {
  Eigen::Affine3d y_up(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitX()));
  Move(y_up, points);
  WritePly();
  ExpectRefusal("cameras stand outside it", "--points-up y");
  options.up = CloudUp::kY;
  EXPECT_GT(ReadCloud(options, scene, context).size(), 1000u);
  // In millimetres too.
  Move(Eigen::Affine3d(Eigen::Matrix3d(1000 * Eigen::Matrix3d::Identity())), points);
  WritePly();
  ExpectRefusal("m across", "--points-scale 0.001");
  options.scale = 0.001;
  const std::vector<ScenePoint> read = ReadCloud(options, scene, context);
  ASSERT_GT(read.size(), 1000u);
  double highest = 0;
  for (const ScenePoint& point : read) highest = std::max(highest, point.position.z());
  EXPECT_NEAR(highest, 2.5, 1e-5);
}

TEST_F(ReadCloudTest, RefusesACloudOfAnotherPlace) {
  Move(Eigen::Affine3d(Eigen::Translation3d(40, 0, 0)), points);
  WritePly();
  ExpectRefusal("4 of 4 cameras stand outside it", "made with these poses");
}

TEST_F(ReadCloudTest, RefusesAFloorAboveTheCameras) {
  Move(Eigen::Affine3d(Eigen::Translation3d(0, 0, 1.6)), points);
  WritePly();
  ExpectRefusal("its lowest points are at 1.60 m", "made with these poses");
}

TEST_F(ReadCloudTest, RefusesNormalsThatLookAway) {
  for (ScenePoint& point : points) point.normal = -point.normal;
  WritePly();
  WriteVisibility(options.file + ".vis", points);
  std::ofstream(temp / "names.txt") << "pano_0.jpg\npano_1.jpg\npano_2.jpg\npano_3.jpg\n";
  options.images = (temp / "names.txt").native();
  ExpectRefusal("of its normals 100 % turn away", "made with these poses");
}

TEST_F(ReadCloudTest, RefusesFewerThanAHundredPoints) {
  points.resize(99);
  WritePly();
  ExpectRefusal("has 99 points, too few: 100", "give a dense cloud");
  points = RoomPoints(scene);
  for (ScenePoint& point : points) point.normal.setZero();
  WritePly();
  ExpectRefusal("without normals", "write normals");
}

TEST_F(ReadCloudTest, RefusesImagesThatAreNoPicturesOfTheScene) {
  WritePly();
  WriteVisibility(options.file + ".vis", points);
  options.images = (temp / "names.txt").native();
  std::ofstream(options.images) << "a\nb\nc\nd\n";
  try {
    (void)ReadCloud(options, scene, context);
    ADD_FAILURE();
  } catch (const InvalidInputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("names no picture of this scene; the first is 'a'"));
  }
  // Some are: what the others see is left out.
  std::ofstream(options.images) << "a\npano_2.jpg\nview_1/pano_2.jpg\npano_0.jpg\n";
  const std::vector<ScenePoint> read = ReadCloud(options, scene, context);
  ASSERT_EQ(read.size(), points.size());
  for (const ScenePoint& point : read) EXPECT_THAT(point.view_idx, testing::ElementsAre(0, 2));
}

TEST_F(ReadCloudTest, ModelBringsItIntoTheWorldWhateverItsAxesAndUnit) {
  const Eigen::Affine3d cloud_from_world =
      Eigen::Translation3d(3, -7, 20) * Eigen::AngleAxisd(1.2, Vector3d(1, 2, -0.5).normalized()) *
      Eigen::Scaling(0.17);
  Scene model = scene;
  for (View& view : model.views) {
    view.world_from_cam.translation = cloud_from_world * view.world_from_cam.translation;
  }
  const std::vector<ScenePoint> truth = points;
  Move(cloud_from_world, points);
  WritePly();
  ExpectRefusal("is not in the world of the poses", "made with these poses");
  WriteVisibility(options.file + ".vis", points);
  WriteColmapModel(temp / "sparse", model, ColmapForm::kEquirectangular, ColmapEncoding::kText);
  const std::vector<ScenePoint> read = ReadCloud(options, scene, context);
  ASSERT_EQ(read.size(), truth.size());
  for (size_t i = 0; i < read.size(); ++i) {
    EXPECT_LT((read[i].position - truth[i].position).norm(), 1e-4);
    EXPECT_LT((read[i].normal - truth[i].normal).norm(), 1e-4);
    EXPECT_EQ(read[i].view_idx, truth[i].view_idx);
  }
  // A model of other poses.
  std::swap(model.views[0].world_from_cam, model.views[2].world_from_cam);
  WriteColmapModel(temp / "sparse", model, ColmapForm::kEquirectangular, ColmapEncoding::kText);
  ExpectRefusal("is of other poses", "made with these poses");
}

TEST(CloudFile, ComesBackAsItWas) {
  const TempFolder temp;
  const Scene scene = SceneOfFour();
  std::vector<ScenePoint> points = RoomPoints(scene);
  points[7].view_idx = {2};
  points[8].view_idx.clear();
  WriteCloudFile(temp / "cloud.bin", points);
  const std::vector<ScenePoint> read = ReadCloudFile(temp / "cloud.bin", 4);
  ASSERT_EQ(read.size(), points.size());
  for (size_t i = 0; i < read.size(); ++i) {
    ASSERT_EQ(read[i].position, points[i].position);
    ASSERT_EQ(read[i].normal, points[i].normal);
    ASSERT_EQ(read[i].rgb, points[i].rgb);
    ASSERT_EQ(read[i].view_idx, points[i].view_idx);
  }
  EXPECT_THROW((void)ReadCloudFile(temp / "cloud.bin", 3), InvalidInputError);
  points.resize(3);
  WriteCloudFile(temp / "cloud.bin", points);
  ExpectRefusesDamage(temp / "cloud.bin", [&] { (void)ReadCloudFile(temp / "cloud.bin", 4); });
  const uint64_t huge = uint64_t{1} << 31;
  Poke(temp / "cloud.bin", 12, &huge, sizeof(huge));
  EXPECT_THROW((void)ReadCloudFile(temp / "cloud.bin", 4), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
