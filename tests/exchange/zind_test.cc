// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

class ZindTest : public PoseFormatTest {
 protected:
  static Json Panorama(const std::string& path, double x, double y, double rotation) {
    return {{"image_path", path},
            {"camera_height", 1},
            {"floor_plan_transformation",
             {{"translation", {x, y}}, {"rotation", rotation}, {"scale", 0.5}}}};
  }
  // Two floors with 3 m per coordinate: camera height 1.5 m.
  static Json Tour() {
    Json tour{{"scale_meters_per_coordinate", {{"floor_01", 3.0}, {"floor_02", 3.0}}}};
    tour["merger"]["floor_01"]["room"]["part"]["p1"] = Panorama("images/a.png", 1, 2, 0);
    tour["merger"]["floor_02"]["room"]["part"]["p2"] = Panorama("images/b.png", -1, 0, 90);
    return tour;
  }
  void Write(const Json& tour) { WriteJsonFile(folder / "zind_data.json", tour); }
  std::string RefusalAfter(const std::function<void(Json&)>& change) {
    Json tour = Tour();
    change(tour);
    Write(tour);
    return SceneRefusal(folder);
  }
};

TEST_F(ZindTest, ReadsPositionsYawHeightsAndScale) {
  Write(Tour());
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_EQ(report.scene.camera_height_m, 1.5);
  const View& a = ViewOf(report.scene, "a.png");
  EXPECT_EQ(a.storey_idx, 0);
  EXPECT_TRUE(a.world_from_cam.translation.isApprox(Eigen::Vector3d(3, -6, 1.5), 1e-12));
  Eigen::Matrix3d facing_back;  // right −x, down −z, forward −y
  facing_back << -1, 0, 0, 0, 0, -1, 0, -1, 0;
  EXPECT_TRUE(a.world_from_cam.rotation.isApprox(facing_back, 1e-12));
  const View& b = ViewOf(report.scene, "b.png");
  EXPECT_EQ(b.storey_idx, 1);
  EXPECT_TRUE(b.world_from_cam.translation.isApprox(Eigen::Vector3d(-3, 0, 4.5), 1e-12));
  EXPECT_TRUE(b.world_from_cam.rotation.col(2).isApprox(Eigen::Vector3d(-1, 0, 0), 1e-12));
}

TEST_F(ZindTest, GroupingNamesAndAnnotationChangeNothing) {
  Json annotated = Tour();
  for (const char* floor : {"floor_01", "floor_02"}) {
    for (Json& panorama : annotated["merger"][floor]["room"]["part"]) {
      panorama["label"] = "kitchen";
      panorama["is_primary"] = true;
      panorama["layout_raw"] = {{"vertices", "even if it is broken"}};
    }
  }
  annotated["redraw"] = 3;
  Write(annotated);
  const Scene scene = ReadTestScene(folder).scene;

  const TempFolder other;
  fs::create_directories(other / "panos");
  fs::copy(folder / "images" / "a.png", other / "panos" / "9.png");
  fs::copy(folder / "images" / "b.png", other / "panos" / "1.png");
  Json stripped{{"scale_meters_per_coordinate", Tour()["scale_meters_per_coordinate"]}};
  stripped["merger"]["floor_01"]["x"] = Panorama("gone/9.png", 1, 2, 0);
  stripped["merger"]["floor_02"]["a"]["b"]["c"]["d"] = Panorama("panos/1.png", -1, 0, 90);
  WriteJsonFile(other / "zind_data.json", stripped);
  const Scene same = ReadTestScene(other.path()).scene;
  ASSERT_EQ(same.views.size(), scene.views.size());
  for (size_t i = 0; i < scene.views.size(); ++i) {
    EXPECT_EQ(same.views[i].sha256, scene.views[i].sha256);
    EXPECT_EQ(same.views[i].world_from_cam.Matrix(), scene.views[i].world_from_cam.Matrix());
    EXPECT_EQ(same.views[i].storey_idx, scene.views[i].storey_idx);
  }
}

TEST_F(ZindTest, AnUnknownScaleComesFromTheCameraHeight) {
  Json tour = Tour();
  tour["scale_meters_per_coordinate"] = {{"floor_01", nullptr}, {"floor_02", nullptr}};
  Write(tour);
  SceneReadReport report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kAssumed);
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("scale of floor_01 is unknown"),
                                           HasSubstr("scale of floor_02 is unknown")));
  EXPECT_NEAR(ViewOf(report.scene, "a.png").world_from_cam.translation.z(), 1.5, 1e-12);

  SceneReadOptions options;
  options.camera_height_m = 2;
  report = ReadTestScene(folder, options);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kCameraHeight);
  EXPECT_TRUE(ViewOf(report.scene, "a.png")
                  .world_from_cam.translation.isApprox(Eigen::Vector3d(4, -8, 2), 1e-12));

  tour["scale_meters_per_coordinate"]["floor_02"] = 2.0;  // cameras of floor 2 at 1 m
  Write(tour);
  report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.scale_source, ScaleSource::kPoses);
  EXPECT_NEAR(ViewOf(report.scene, "a.png").world_from_cam.translation.z(), 1.0, 1e-12);

  tour.erase("scale_meters_per_coordinate");
  Write(tour);
  EXPECT_EQ(ReadTestScene(folder).scene.scale_source, ScaleSource::kAssumed);
}

TEST_F(ZindTest, LeavesOutPanoramasWithoutPosition) {
  Json tour = Tour();
  tour["merger"]["floor_02"]["room"]["part"]["p2"].erase("floor_plan_transformation");
  Write(tour);
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_EQ(report.scene.views.size(), 1U);
  EXPECT_EQ(report.num_unposed, 1);
}

TEST_F(ZindTest, RefusesWrongContent) {
  using J = Json&;
  const auto panorama = [](J j) -> J { return j["merger"]["floor_01"]["room"]["part"]["p1"]; };
  EXPECT_THAT(RefusalAfter([](J j) { j.erase("merger"); }), HasSubstr("'merger' is missing"));
  EXPECT_THAT(RefusalAfter([](J j) { j["merger"] = Json::object(); }), HasSubstr("no panorama"));
  EXPECT_THAT(RefusalAfter([](J j) {
                j["merger"] = {{"floor_01", {1, 2}}};
              }),
              HasSubstr("no panorama"));
  EXPECT_THAT(RefusalAfter([&](J j) { panorama(j)["image_path"] = 1; }), HasSubstr("'image_path'"));
  EXPECT_THAT(RefusalAfter([&](J j) { panorama(j)["image_path"] = "gone.png"; }),
              HasSubstr("absent: gone.png"));
  const auto transformation = [&](J j) -> J { return panorama(j)["floor_plan_transformation"]; };
  EXPECT_THAT(RefusalAfter([&](J j) { transformation(j) = 3; }), HasSubstr("make it an object"));
  EXPECT_THAT(RefusalAfter([&](J j) { transformation(j)["scale"] = 0; }),
              HasSubstr("not positive"));
  EXPECT_THAT(RefusalAfter([&](J j) { transformation(j)["rotation"] = nullptr; }),
              HasSubstr("'rotation' is null"));
  EXPECT_THAT(RefusalAfter([&](J j) { transformation(j)["translation"] = {1}; }),
              HasSubstr("pair of numbers"));
  EXPECT_THAT(RefusalAfter([](J j) { j["scale_meters_per_coordinate"]["floor_01"] = -1; }),
              HasSubstr("not positive"));
  EXPECT_THAT(RefusalAfter([](J j) { j["scale_meters_per_coordinate"]["floor_01"] = "3"; }),
              HasSubstr("not a number"));
}

TEST_F(ZindTest, RefusesBrokenFiles) {
  const std::string whole = Tour().dump();
  for (size_t size = 0; size < whole.size(); size += 37) {
    WriteFileAtomic(folder / "zind_data.json", whole.substr(0, size));
    EXPECT_THAT(SceneRefusal(folder), HasSubstr("no valid JSON")) << size;
  }
}

}  // namespace
}  // namespace enfilade
