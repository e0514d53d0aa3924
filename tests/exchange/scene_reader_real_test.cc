// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/geometry/angles.h"
#include "tests/support/real_data.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

constexpr char kTour[] = "zind_sample_tour/000";

SceneReadReport Read(const std::filesystem::path& folder) {
  RunContext context;
  return ReadScene(folder, {}, context);
}

TEST(SceneReaderReal, ReadsTheTour) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  const SceneReadReport report = Read(RealDataFolder() / kTour);
  EXPECT_THAT(report.warnings, testing::IsEmpty());
  EXPECT_EQ(report.scene.views.size(), 32U);
  EXPECT_EQ(report.scene.pose_source, PoseSource::kZind);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kPoses);
  ASSERT_TRUE(report.scene.camera_height_m.has_value());
  EXPECT_NEAR(*report.scene.camera_height_m, 1.435, 0.001);
  for (const View& view : report.scene.views) {
    EXPECT_EQ(view.camera.width, 2048);
    EXPECT_EQ(view.storey_idx, 0);
    EXPECT_NEAR(view.world_from_cam.translation.z(), 1.435, 0.001);
    EXPECT_NEAR((view.world_from_cam.rotation.determinant()), 1.0, 1e-12);
  }
}

// The data set's image rule for a point of a panorama's local frame (data/README.md, checked on the
// pictures), written without any of the reader's conversions.
Eigen::Vector2d PixelOfLocalPoint(const Eigen::Vector3d& p, int width, int height) {
  const double theta = std::atan2(-p.x(), p.y());
  const double phi = std::asin(p.z() / p.norm());
  return {(theta + kPi) / (2 * kPi) * (width - 1) + 0.5, (0.5 - phi / kPi) * (height - 1) + 0.5};
}

// Every annotated corner, taken to the world by the data set's rules, must project through our pose
// and camera to the pixel that the image rule gives: this fails for any mistake in handedness, yaw,
// scale, camera height or axes.
TEST(SceneReaderReal, AnnotatedCornersProjectToTheirPixels) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  const SceneReadReport report = Read(RealDataFolder() / kTour);
  const Json tour = ReadJsonFile(RealDataFolder() / kTour / "zind_data.json");
  const double m = tour["scale_meters_per_coordinate"]["floor_01"].get<double>();
  int num_corners = 0;
  for (const auto& [room_key, room] : tour["merger"]["floor_01"].items()) {
    for (const auto& [part_key, part] : room.items()) {
      for (const auto& [key, panorama] : part.items()) {
        const auto view =
            std::find_if(report.scene.views.begin(), report.scene.views.end(), [&](const View& v) {
              return panorama["image_path"].get<std::string>().ends_with(v.picture);
            });
        ASSERT_NE(view, report.scene.views.end());
        const Json& t = panorama["floor_plan_transformation"];
        const double scale = t["scale"].get<double>();
        const double yaw = DegToRad(t["rotation"].get<double>());
        for (const Json& corner : panorama["layout_complete"]["vertices"]) {
          const Eigen::Vector2d local(corner[0].get<double>(), corner[1].get<double>());
          const Eigen::Vector2d g =
              scale * (Eigen::Rotation2Dd(yaw) * local) +
              Eigen::Vector2d(t["translation"][0].get<double>(), t["translation"][1].get<double>());
          const Eigen::Vector3d on_floor(m * g.x(), -m * g.y(), 0);
          const auto pixel = view->camera.PixelFromRay(view->world_from_cam.Inverse() * on_floor);
          const Eigen::Vector2d expected = PixelOfLocalPoint(
              {local.x(), local.y(), -1}, view->camera.width, view->camera.height);
          const double turns = (pixel->x() - expected.x()) / view->camera.width;
          EXPECT_LT(std::abs(turns - std::round(turns)) * view->camera.width, 0.6);
          EXPECT_NEAR(pixel->y(), expected.y(), 0.6);
          ++num_corners;
        }
      }
    }
  }
  EXPECT_GT(num_corners, 300);
}

// A tour with nothing but what may be read: one group, new names, no annotation.
std::filesystem::path StripTour(const std::filesystem::path& source,
                                const std::filesystem::path& target) {
  const Json tour = ReadJsonFile(source / "zind_data.json");
  std::filesystem::create_directories(target / "panos");
  Json stripped{{"scale_meters_per_coordinate", tour["scale_meters_per_coordinate"]}};
  Json& panoramas = stripped["merger"]["floor_01"]["all"]["all"];
  int number = 0;
  for (const auto& [room_key, room] : tour["merger"]["floor_01"].items()) {
    for (const auto& [part_key, part] : room.items()) {
      for (const auto& [key, panorama] : part.items()) {
        const std::string name = fmt::format("panos/{}.jpg", (number * 7 + 3) % 32);
        std::filesystem::create_symlink(source / panorama["image_path"].get<std::string>(),
                                        target / name);
        panoramas[fmt::format("p{}", number++)] = {
            {"image_path", name},
            {"camera_height", panorama["camera_height"]},
            {"floor_plan_transformation", panorama["floor_plan_transformation"]}};
      }
    }
  }
  WriteJsonFile(target / "zind_data.json", stripped);
  return target;
}

TEST(SceneReaderReal, AStrippedFlattenedRenamedTourIsTheSameScene) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  const TempFolder temp;
  const auto source = std::filesystem::absolute(RealDataFolder() / kTour);
  const Scene whole = Read(source).scene;
  const Scene stripped = Read(StripTour(source, temp / "tour")).scene;
  ASSERT_EQ(stripped.views.size(), whole.views.size());
  for (size_t i = 0; i < whole.views.size(); ++i) {
    EXPECT_EQ(stripped.views[i].sha256, whole.views[i].sha256);
    EXPECT_EQ(stripped.views[i].world_from_cam.Matrix(), whole.views[i].world_from_cam.Matrix());
    EXPECT_EQ(stripped.views[i].storey_idx, whole.views[i].storey_idx);
  }
  EXPECT_EQ(stripped.camera_height_m, whole.camera_height_m);
}

TEST(SceneReaderReal, ReadsTheRenderedRooms) {
  ENFILADE_REQUIRE_REAL_DATA("pano3dlayout");
  int num_rooms = 0;
  for (const auto& room : std::filesystem::directory_iterator(RealDataFolder() / "pano3dlayout")) {
    if (!room.is_directory()) continue;
    SCOPED_TRACE(room.path());
    const SceneReadReport report = Read(room.path());
    EXPECT_THAT(report.warnings, testing::IsEmpty());
    EXPECT_THAT(report.scene.views.size(), testing::AllOf(testing::Ge(3U), testing::Le(4U)));
    EXPECT_EQ(report.scene.pose_source, PoseSource::kTransforms);
    for (const View& view : report.scene.views) {
      // Upright cameras: the camera's y axis points down.
      EXPECT_NEAR(view.world_from_cam.rotation(2, 1), -1, 1e-3);
    }
    ++num_rooms;
  }
  EXPECT_EQ(num_rooms, 7);
}

}  // namespace
}  // namespace enfilade
