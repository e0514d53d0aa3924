// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// Files with bytes changed, removed, doubled and overwritten by hostile words: whatever a reader is
// given, it reads it or refuses it with a UserError. Anything else, a crash above all, is a bug.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/exchange/ply_writer.h"
#include "enfilade/exchange/point_cloud_reader.h"
#include "enfilade/exchange/point_cloud_writer.h"
#include "enfilade/exchange/scene_json.h"
#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int kNumMutations = 300;

uint64_t NextRandom(uint64_t& state) {  // SplitMix64
  uint64_t z = state += 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return z ^ (z >> 31);
}

std::string Mutate(std::string bytes, uint64_t& state) {
  static const std::vector<std::string> kWords = {
      "null", "-1", "1e308", "-1e308", "0", "[]", "{}", "\"\"", "99999999999", "nan", ",", "\n"};
  const int num_changes = 1 + static_cast<int>(NextRandom(state) % 3);
  for (int i = 0; i < num_changes && !bytes.empty(); ++i) {
    const size_t at = NextRandom(state) % bytes.size();
    const size_t length = 1 + NextRandom(state) % 8;
    switch (NextRandom(state) % 4) {
      case 0:
        bytes[at] = static_cast<char>(NextRandom(state));
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, 4 * length));
        break;
      default:
        bytes.replace(at, length, kWords[NextRandom(state) % kWords.size()]);
    }
  }
  return bytes;
}

void Overwrite(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Reads mutated versions of `file`, of which some but not all must be refused.
void ExpectReadOrRefused(const fs::path& file, const std::function<void()>& read) {
  const std::string whole = ReadFile(file);
  ASSERT_NO_THROW(read());
  uint64_t state = 1;
  int num_refused = 0;
  for (int i = 0; i < kNumMutations; ++i) {
    const std::string mutated = Mutate(whole, state);
    Overwrite(file, mutated);
    try {
      read();
    } catch (const UserError&) {
      ++num_refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << ": " << error.what() << "\n" << mutated;
      return;
    }
  }
  EXPECT_GT(num_refused, kNumMutations / 10);
  EXPECT_LT(num_refused, kNumMutations);
}

class ReaderMutationTest : public PoseFormatTest {
 protected:
  void ExpectScene(const fs::path& file, const std::string& bytes) {
    fs::create_directories(file.parent_path());
    Overwrite(file, bytes);
    ExpectReadOrRefused(file, [&] { (void)ReadTestScene(folder); });
  }
};

constexpr char kTour[] = R"({"scale_meters_per_coordinate": {"floor_01": 3.5, "floor_02": null},
"merger": {"floor_01": {"complete_room_01": {"partial_room_01": {"pano_1": {
  "image_path": "images/a.png", "camera_height": 1, "ceiling_height": 1.6, "is_inside": true,
  "floor_plan_transformation": {"translation": [0.5, -1], "rotation": 30, "scale": 0.4},
  "layout_complete": {"vertices": [[-1, -1], [2, -1], [2, 1], [-1, 1]],
    "doors": [[-1, 0], [-1, 0.5], [-1, 0.4]], "openings": []}}}}},
"floor_02": {"r": {"p": {"pano_2": {"image_path": "images/b.png", "camera_height": 1,
  "floor_plan_transformation": {"translation": [0, 0], "rotation": 0, "scale": 0.4}}}}}}})";

TEST_F(ReaderMutationTest, Transforms) {
  ExpectScene(
      folder / "transforms.json",
      EquirectangularTransforms({UprightFrame("images/a.png"), UprightFrame("images/b.png", 2)})
          .dump());
}

TEST_F(ReaderMutationTest, PoseCsv) {
  ExpectScene(folder / "poses.csv",
              "file,x,y,z,qw,qx,qy,qz\na.png,1,2,3,1,0,0,0\n\"b.png\",2,2,3,0,0,0,1\n");
}

TEST_F(ReaderMutationTest, ColmapText) {
  const std::vector<std::pair<fs::path, std::string>> files = {
      {folder / "cameras.txt", "5 PINHOLE 16 8 20 20 8 4\n"},
      {folder / "images.txt",
       "3 0.70710678 0.70710678 0 0 0 3 0 5 a.png\n1 2 -1\n"
       "9 0.70710678 0.70710678 0 0 -4 3 0 5 b.png\n\n"},
      {folder / "points3D.txt", "1 0 1 0 10 20 30 0.5 3 0\n2 0.1 1 0 10 20 30 0.5 9 0 3 0\n"}};
  for (const auto& [file, bytes] : files) Overwrite(file, bytes);
  for (const auto& [file, bytes] : files) {
    ExpectScene(file, bytes);
    Overwrite(file, bytes);
  }
}

TEST_F(ReaderMutationTest, Zind) { ExpectScene(folder / "zind_data.json", kTour); }

TEST_F(ReaderMutationTest, ZindTruth) {
  Overwrite(folder / "zind_data.json", kTour);
  ExpectReadOrRefused(folder / "zind_data.json", [&] { (void)ReadGroundTruth(folder); });
}

TEST_F(ReaderMutationTest, ObjTruth) {
  Overwrite(folder / "layout.obj",
            "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2\nv 4 0 2\nv 4 3 2\nv 0 3 2\n"
            "f 1 2 3 4\nf 5 6 7 8\nf 1/1 2/1 6/1 5/1\nf -8 -5 -1 -4\n");
  ExpectReadOrRefused(folder / "layout.obj", [&] { (void)ReadGroundTruth(folder); });
}

TEST_F(ReaderMutationTest, FloorplanJsonAsPlanAndAsTruth) {
  const fs::path file = folder / "floorplan.json";
  Floorplan plan;
  Storey storey;
  storey.rooms.push_back(
      {0, {ParseRing("0,0 4,0 4,3 0,3"), {ParseRing("1,1 1,2 2,2")}}, 0, 2.5, 0});
  storey.walls.push_back({0, {4, 0}, {4, 3}, 0, std::nullopt, 0.1, true, WallSeen::kSeen, 0});
  storey.openings.push_back({0, OpeningKind::kDoor, 0, {4, 1}, {4, 1.8}, 0, 2, 0, std::nullopt});
  plan.storeys.push_back(storey);
  plan.cameras.push_back({"a.png", "", 0, 0, false, {UprightRotation(), {1, 1, 1}}});
  WriteFloorplanJson(file, plan, nlohmann::json::object());
  const std::string whole = ReadFile(file);
  ExpectReadOrRefused(file, [&] { (void)ReadFloorplanJson(file); });
  Overwrite(file, whole);
  ExpectReadOrRefused(file, [&] { (void)ReadGroundTruth(folder); });
}

TEST_F(ReaderMutationTest, SceneJson) {
  WriteJsonFile(folder / "transforms.json",
                EquirectangularTransforms({UprightFrame("images/a.png")}));
  Scene scene = ReadTestScene(folder).scene;
  scene.points.push_back({{1, 2, 3}, {0, 0, 1}, {1, 2, 3}, {0}});
  WriteSceneJson(folder / "scene.json", scene);
  ExpectReadOrRefused(folder / "scene.json", [&] { (void)ReadSceneJson(folder / "scene.json"); });
}

std::vector<ScenePoint> TwoPoints() {
  std::vector<ScenePoint> points(2);
  for (ScenePoint& point : points) point.normal = {0, 0, 1};
  points[0].position = {1, 2.5, -3};
  points[0].view_idx = {0};
  points[1].view_idx = {0, 1};
  return points;
}

TEST_F(ReaderMutationTest, AsciiPly) {
  Overwrite(folder / "x.ply",
            "ply\nformat ascii 1.0\nelement a 1\nproperty list uchar int b\nelement vertex 2\n"
            "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty "
            "float ny\nproperty float nz\nend_header\n2 3 4\n1 2 3 0 0 1\n4 5 6 1 0 0\n");
  ExpectReadOrRefused(folder / "x.ply", [&] { (void)ReadPointCloud(folder / "x.ply", ""); });
}

TEST_F(ReaderMutationTest, FusedPlyAndItsVisibility) {
  const fs::path ply = folder / "x.ply", vis = folder / "x.ply.vis", list = folder / "list.txt";
  WritePointsPly(ply, TwoPoints());
  WriteVisibility(vis, TwoPoints());
  Overwrite(list, "a.png\nb.png\n");
  const std::string whole = ReadFile(ply);
  const auto read = [&] { (void)ReadPointCloud(ply, list); };
  ExpectReadOrRefused(ply, read);
  Overwrite(ply, whole);
  ExpectReadOrRefused(vis, read);
}

TEST_F(ReaderMutationTest, Patches) {
  WritePatches(folder / "x.patch", TwoPoints());
  Overwrite(folder / "list.txt", "a.png\nb.png\n");
  ExpectReadOrRefused(folder / "x.patch", [&] { (void)ReadPointCloud(folder / "x.patch", ""); });
}

}  // namespace
}  // namespace enfilade
