// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/obj_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "enfilade/model/extrude.h"
#include "tests/support/plan_fixtures.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

BuildingModel TexturedModel() {
  BuildingModel model =
      ExtrudeFloorplan(MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3"), MakeRoom(1, "4,0 7,0 7,3 4,3")}));
  model.textures.emplace_back(16, 16, 3, uint8_t{120});
  for (ModelFace& face : model.faces) {
    face.uv.assign(face.vertices.size(), Eigen::Vector2d(0.25, 0.75));
  }
  return model;
}

// What a reader of the format makes of the text.
struct ParsedObj {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector2d> texture_vertices;
  std::map<std::string, std::vector<std::array<int, 3>>> triangles_of_group;
  std::vector<std::string> materials, libraries;
};

ParsedObj ParseObj(const std::string& text) {
  ParsedObj obj;
  std::istringstream lines(text);
  std::string line, group;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      obj.positions.push_back(p);
    } else if (key == "vt") {
      Eigen::Vector2d uv;
      words >> uv.x() >> uv.y();
      obj.texture_vertices.push_back(uv);
    } else if (key == "g") {
      words >> group;
    } else if (key == "usemtl") {
      words >> obj.materials.emplace_back();
    } else if (key == "mtllib") {
      words >> obj.libraries.emplace_back();
    } else if (key == "f") {
      std::array<int, 3> triangle{};
      for (int& corner : triangle) {
        std::string indices;
        words >> indices;
        corner = std::stoi(indices) - 1;
      }
      obj.triangles_of_group[group].push_back(triangle);
    }
  }
  return obj;
}

TEST(WriteObj, GroupsAndPositionsReadBack) {
  const TempFolder folder;
  const BuildingModel model = TexturedModel();
  WriteObj(folder / "model.obj", model);
  const ParsedObj obj = ParseObj(ReadFile(folder / "model.obj"));
  EXPECT_EQ(obj.libraries, std::vector<std::string>{"model.mtl"});
  EXPECT_EQ(obj.triangles_of_group.size(), model.faces.size());
  ASSERT_TRUE(obj.triangles_of_group.contains("storey_0/room_1/wall_5"));
  // Eight corners a room, shared by its six faces.
  EXPECT_EQ(obj.positions.size(), 16u);
  const auto& floor = obj.triangles_of_group.at("storey_0/room_0/floor");
  double area = 0;
  for (const std::array<int, 3>& t : floor) {
    area += 0.5 * (obj.positions[t[1]] - obj.positions[t[0]])
                      .cross(obj.positions[t[2]] - obj.positions[t[0]])
                      .z();
  }
  EXPECT_NEAR(area, 12, 1e-9);
}

TEST(WriteObj, EveryRoomIsWatertightByIndex) {
  const TempFolder folder;
  WriteObj(folder / "model.obj", TexturedModel());
  const ParsedObj obj = ParseObj(ReadFile(folder / "model.obj"));
  std::map<std::pair<int, int>, int> edges;
  for (const auto& [group, triangles] : obj.triangles_of_group) {
    for (const std::array<int, 3>& t : triangles) {
      for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(WriteObj, TexturesAreRelativeFilesWithVFromTheBottom) {
  const TempFolder folder;
  WriteObj(folder / "model.obj", TexturedModel());
  const ParsedObj obj = ParseObj(ReadFile(folder / "model.obj"));
  EXPECT_EQ(obj.texture_vertices.at(0), Eigen::Vector2d(0.25, 0.25));
  EXPECT_EQ(obj.materials.at(0), "atlas_0");
  EXPECT_THAT(ReadFile(folder / "model.mtl"), testing::HasSubstr("map_Kd textures/atlas_0.jpg\n"));
  EXPECT_NEAR(ReadImageRgb(folder / "textures" / "atlas_0.jpg")(3, 3, 1), 120, 2);
}

TEST(WriteObj, ModelWithoutTexturesUsesPlainColours) {
  const TempFolder folder;
  WriteObj(folder / "model.obj", ExtrudeFloorplan(MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3")})));
  const ParsedObj obj = ParseObj(ReadFile(folder / "model.obj"));
  EXPECT_EQ(obj.materials.at(0), "floor");
  EXPECT_TRUE(obj.texture_vertices.empty());
  EXPECT_FALSE(std::filesystem::exists(folder / "textures"));
}

TEST(WriteObj, FileInTheWayIsAnIoError) {
  const TempFolder folder;
  WriteFileAtomic(folder / "textures", "x");
  EXPECT_THROW(WriteObj(folder / "model.obj", TexturedModel()), IoError);
  EXPECT_FALSE(std::filesystem::exists(folder / "model.obj"));
}

}  // namespace
}  // namespace enfilade
