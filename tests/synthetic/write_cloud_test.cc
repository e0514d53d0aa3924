// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/write_cloud.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>

#include "enfilade/exchange/point_cloud_reader.h"
#include "enfilade/structure/point_labels.h"
#include "enfilade/synthetic/fixture_points.h"
#include "enfilade/synthetic/text_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

Home TwoRooms() {
  return TextHome(
      "room 0,0 4,0 4,3 0,3 | room 4.12,0 8,0 8,3 4.12,3 | door 4,1 4,1.8 | box 1,2 1.6,2.6 height "
      "0.8 | camera 1,1.5 | camera 2.5,1 | camera 6,1.4");
}

// As a run of the program would have it: views in another order than the home's cameras.
Scene SceneOf(const Home& home) {
  Scene scene;
  scene.views.resize(home.cameras.size());
  for (size_t i = 0; i < home.cameras.size(); ++i)
    scene.views[home.cameras.size() - 1 - i].picture = home.cameras[i].picture;
  return scene;
}

void TakeCloud(const fs::path& path, Scene& scene) {
  PointCloud cloud = ReadPointCloud(path, "");
  const std::vector<int> view_of = ViewsOfImages(cloud.images, scene);
  for (ScenePoint& point : cloud.points) {
    for (int& image : point.view_idx) image = view_of[static_cast<size_t>(image)];
  }
  scene.points = std::move(cloud.points);
}

// Points with noise, outliers and holes: both readers give the same points, the same views and the
// same labels.
TEST(WriteClouds, BothReadersGiveTheSame) {
  const TempFolder temp;
  const Home home = TwoRooms();
  PointNoise noise;
  noise.half_contrast = 0;  // white walls too
  const std::vector<ScenePoint> points = FixturePoints(home, noise);
  ASSERT_GT(points.size(), 10000u);
  WriteClouds(temp.path(), home, points);
  Scene fused = SceneOf(home), patches = SceneOf(home);
  TakeCloud(temp / "dense" / "fused.ply", fused);
  TakeCloud(temp / "pmvs" / "models" / "option-0000.patch", patches);
  ASSERT_EQ(fused.points.size(), points.size());
  ASSERT_EQ(patches.points.size(), points.size());

  Structure structure;
  structure.home_from_world = home.home_from_world;
  structure.storeys = {{0, home.rooms[0].ceiling_z, 0}};
  const std::vector<SurfaceLabel> labels = LabelPoints(fused, structure);
  EXPECT_EQ(labels, LabelPoints(patches, structure));
  const auto last = static_cast<int>(home.cameras.size()) - 1;
  for (size_t i = 0; i < points.size(); ++i) {
    const ScenePoint& point = fused.points[i];
    EXPECT_EQ(point.position, patches.points[i].position);
    EXPECT_EQ(point.normal, patches.points[i].normal);
    EXPECT_EQ(point.rgb, patches.points[i].rgb);
    EXPECT_EQ(point.view_idx, patches.points[i].view_idx);
    EXPECT_LT((point.position - points[i].position).norm(), 1e-5);
    ASSERT_EQ(point.view_idx.size(), points[i].view_idx.size());
    for (size_t k = 0; k < point.view_idx.size(); ++k)
      EXPECT_EQ(point.view_idx[k], last - points[i].view_idx[k]);
  }
  std::map<SurfaceLabel, int> count;
  for (const SurfaceLabel label : labels) ++count[label];
  for (const auto label : {SurfaceLabel::kFloor, SurfaceLabel::kWall, SurfaceLabel::kCeiling})
    EXPECT_GT(count[label], 1000) << static_cast<int>(label);
}

// Without noise the labels are those of the surfaces.
TEST(WriteClouds, LabelsOfPerfectPointsAreRight) {
  const TempFolder temp;
  const Home home = TwoRooms();
  PointNoise perfect;
  perfect.half_contrast = perfect.match_sigma_deg = perfect.ray_sigma_deg = 0;
  perfect.normal_sigma_deg = perfect.outlier_share = perfect.clump_share = perfect.hole_share = 0;
  perfect.match_probability = 1;
  WriteClouds(temp.path(), home, FixturePoints(home, perfect));
  Scene scene = SceneOf(home);
  TakeCloud(temp / "pmvs" / "models" / "option-0000.patch", scene);
  Structure structure;
  structure.storeys = {{0, home.rooms[0].ceiling_z, 0}};
  const std::vector<SurfaceLabel> labels = LabelPoints(scene, structure);
  int num_top = 0;
  for (size_t i = 0; i < labels.size(); ++i) {
    const Eigen::Vector3d p = scene.points[i].position;
    const double nz = scene.points[i].normal.z();
    if (p.z() < 1e-3 && nz > 0.9) {
      EXPECT_EQ(labels[i], SurfaceLabel::kFloor);
    }
    if (p.z() > home.rooms[0].ceiling_z - 1e-3 && nz < -0.9) {
      EXPECT_EQ(labels[i], SurfaceLabel::kCeiling);
    }
    const bool is_on_wall = p.x() < 1e-3 || p.y() < 1e-3 || p.x() > 8 - 1e-3 || p.y() > 3 - 1e-3;
    if (is_on_wall && p.z() > 0.3 && p.z() < 2) {
      EXPECT_EQ(labels[i], SurfaceLabel::kWall);
    }
    const bool is_on_box = std::abs(p.z() - 0.8) < 1e-3 && p.x() > 1.01 && p.x() < 1.59 &&
                           p.y() > 2.01 && p.y() < 2.59;
    if (is_on_box) {
      EXPECT_EQ(labels[i], SurfaceLabel::kOther);
    }
    num_top += is_on_box;
  }
  EXPECT_GT(num_top, 50);
}

TEST(RemoveClouds, TakesAwayWhatWasWritten) {
  const TempFolder temp;
  const Home home = TwoRooms();
  PointNoise noise;
  noise.spacing_m = 0.5;
  WriteClouds(temp.path(), home, FixturePoints(home, noise));
  std::ofstream(temp / "dense" / "mine.txt") << "x";
  RemoveClouds(temp.path());
  RemoveClouds(temp.path());
  EXPECT_FALSE(fs::exists(temp / "dense" / "fused.ply"));
  EXPECT_FALSE(fs::exists(temp / "pmvs" / "models" / "option-0000.patch"));
  EXPECT_TRUE(fs::exists(temp / "dense" / "mine.txt"));
}

}  // namespace
}  // namespace enfilade
