// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ground_truth_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "enfilade/base/hash.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/geometry/angles.h"
#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::SizeIs;
namespace fs = std::filesystem;

std::string Refusal(const fs::path& folder) {
  try {
    (void)ReadGroundTruth(folder);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

double TotalLength(const std::vector<std::array<Eigen::Vector2d, 2>>& segments) {
  double length = 0;
  for (const auto& [a, b] : segments) length += (b - a).norm();
  return length;
}

TEST(GroundTruthReader, RefusesAFolderWithoutTruth) {
  const TempFolder temp;
  EXPECT_THAT(Refusal(temp.path()), HasSubstr("holds no truth"));
  EXPECT_THAT(Refusal(temp / "absent"), HasSubstr("holds no truth"));
}

// ---- floorplan.json

// Rooms 0–4 × 0–3 and 4.1–6 × 0–3 with a door in the wall between them and a window to the south.
// The home is turned by 90° and lies 1 m lower than its world.
Floorplan TwoRooms() {
  Floorplan plan;
  plan.home_from_world = {RotationZ(kPi / 2), Eigen::Vector3d(0, 0, -1)};
  Storey storey;
  storey.rooms.push_back({0, {ParseRing("0,0 4,0 4,3 0,3"), {}}, 0, 2.5, 0});
  storey.rooms.push_back({1, {ParseRing("4.1,0 6,0 6,3 4.1,3"), {}}, 0, 2.4, 0});
  storey.walls.push_back({0, {4, 0}, {4, 3}, 0, 1, 0.1, true, WallSeen::kSeen, 0});
  storey.walls.push_back({1, {0, 0}, {4, 0}, 0, std::nullopt, 0.2, true, WallSeen::kSeen, 0});
  storey.openings.push_back({0, OpeningKind::kDoor, 0, {4, 1}, {4, 1.8}, 0, 2, 0, 1});
  storey.openings.push_back({1, OpeningKind::kWindow, 1, {1, 0}, {2, 0}, 0.8, 2, 0, std::nullopt});
  plan.storeys.push_back(storey);
  const auto add_camera = [&](const char* name, double x, double y) {
    const Rigid3 home_from_cam{UprightRotation(), Eigen::Vector3d(x, y, 1.4)};
    plan.cameras.push_back({name, std::string(64, name[0]), 0, 0, false,
                            plan.home_from_world.Inverse() * home_from_cam});
  };
  add_camera("a.png", 1, 1);
  add_camera("b.png", 5, 1);
  add_camera("c.png", 9, 9);
  return plan;
}

TEST(FloorplanTruth, DoorsCutBothFacesOfTheirWall) {
  const TempFolder temp;
  WriteFloorplanJson(temp / "truth" / "floorplan.json", TwoRooms(), Json::object());
  const GroundTruth truth = ReadGroundTruth(temp.path());
  ASSERT_THAT(truth.rooms, SizeIs(2));
  // (x, y) of the home is (y, −x) of the world.
  EXPECT_TRUE(Contains(truth.rooms[0].region[0], Eigen::Vector2d(1, -3.9)));
  EXPECT_NEAR(Area(truth.rooms[0].region), 12, 1e-9);
  EXPECT_NEAR(*truth.rooms[0].floor_z, 1, 1e-9);
  EXPECT_NEAR(*truth.rooms[1].ceiling_z, 3.4, 1e-9);
  EXPECT_NEAR(TotalLength(truth.walls), 14 + 9.8 - 2 * 0.8, 1e-6);
  ASSERT_THAT(truth.doors, SizeIs(1));
  EXPECT_TRUE(truth.doors[0][0].isApprox(Eigen::Vector2d(1, -4.05), 1e-6));
}

TEST(FloorplanTruth, ASlopedCeilingHasNoHeight) {
  const TempFolder temp;
  Floorplan plan = TwoRooms();
  plan.storeys[0].rooms[1].has_level_ceiling = false;
  WriteFloorplanJson(temp / "truth" / "floorplan.json", plan, Json::object());
  const GroundTruth truth = ReadGroundTruth(temp.path());
  EXPECT_TRUE(truth.rooms[0].ceiling_z.has_value());
  EXPECT_FALSE(truth.rooms[1].ceiling_z.has_value());
}

TEST(FloorplanTruth, APictureShowsTheOutlineOfItsRoom) {
  const TempFolder temp;
  WriteFloorplanJson(temp / "floorplan.json", TwoRooms(), Json::object());
  const GroundTruth truth = ReadGroundTruth(temp.path());
  ASSERT_THAT(truth.views, SizeIs(3));
  const TruthView& a = truth.views[0];
  EXPECT_EQ(a.picture, "a.png");
  EXPECT_EQ(a.sha256, std::string(64, 'a'));
  EXPECT_TRUE(a.is_inside);
  EXPECT_NEAR(a.camera_height_m, 1.4, 1e-6);
  EXPECT_NEAR(SignedArea(a.visible_layout), 12, 1e-6);
  ASSERT_THAT(a.doors, SizeIs(1));
  EXPECT_NEAR(a.doors[0][0].y(), -4, 1e-6);
  const TruthView& b = truth.views[1];
  ASSERT_THAT(b.doors, SizeIs(1));
  EXPECT_NEAR(b.doors[0][0].y(), -4.1, 1e-6);  // the other face
  EXPECT_FALSE(truth.views[2].is_inside);
}

TEST(FloorplanTruth, ADoorCutsTheFaceBehindItHoweverThickTheWallIsThere) {
  const TempFolder temp;
  Floorplan plan = TwoRooms();
  plan.storeys[0].walls[0].thickness_m = 0.3;  // behind another part of the face
  WriteFloorplanJson(temp / "floorplan.json", plan, Json::object());
  EXPECT_NEAR(TotalLength(ReadGroundTruth(temp.path()).walls), 14 + 9.8 - 2 * 0.8, 1e-6);
}

TEST(FloorplanTruth, APictureWithoutHashIsHashedWhereItExists) {
  const TempFolder temp;
  Floorplan plan = TwoRooms();
  plan.cameras[0].sha256 = plan.cameras[1].sha256 = "";
  WriteTestPicture(temp / "panos" / "a.png", 1);
  WriteFloorplanJson(temp / "truth" / "floorplan.json", plan, Json::object());
  const GroundTruth truth = ReadGroundTruth(temp.path());
  EXPECT_EQ(truth.views[0].sha256, Sha256OfFile(temp / "panos" / "a.png"));
  EXPECT_EQ(truth.views[1].sha256, "");
}

TEST(FloorplanTruth, TheTruthFolderGoesFirst) {
  const TempFolder temp;
  WriteFloorplanJson(temp / "truth" / "floorplan.json", TwoRooms(), Json::object());
  WriteFileAtomic(temp / "floorplan.json", "broken");
  WriteFileAtomic(temp / "zind_data.json", "broken");
  EXPECT_THAT(ReadGroundTruth(temp.path()).rooms, SizeIs(2));
  fs::remove_all(temp / "truth");
  EXPECT_THAT(Refusal(temp.path()), HasSubstr("floorplan.json: is no valid JSON"));
}

// ---- ZInD. Two panoramas in a room of 4 × 3 m; 3 m per coordinate, camera height 1.5 m. The door
// is annotated from the room and, 10 cm off, from the closet behind it.

Json Layout(const std::vector<std::array<double, 2>>& vertices,
            const std::vector<std::array<double, 2>>& doors) {
  return {{"vertices", vertices}, {"doors", doors}, {"openings", Json::array()}};
}

Json Panorama(const std::string& name, double x, double y) {
  return {{"image_path", "panos/" + name},
          {"camera_height", 1},
          {"ceiling_height", 1.6},
          {"is_inside", true},
          {"is_ceiling_flat", true},
          {"floor_plan_transformation",
           {{"translation", {x / 3, y / 3}}, {"rotation", 0}, {"scale", 0.5}}}};
}

// Points in metres of the floor drawing (y down) as a panorama's local points.
std::vector<std::array<double, 2>> Local(const std::vector<std::array<double, 2>>& points, double x,
                                         double y) {
  std::vector<std::array<double, 2>> local;
  for (const auto& p : points) local.push_back({(p[0] - x) / 1.5, (p[1] - y) / 1.5});
  return local;
}

Json Tour() {
  const std::vector<std::array<double, 2>> room = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  const std::vector<std::array<double, 2>> closet = {{4.1, 1}, {5, 1}, {5, 2}, {4.1, 2}};
  const std::vector<std::array<double, 2>> door = {{4, 1.1}, {4, 1.9}, {0, 0}};
  const std::vector<std::array<double, 2>> door_behind = {{4.1, 1.9}, {4.1, 1.1}, {0, 0}};
  Json tour{{"scale_meters_per_coordinate", {{"floor_01", 3.0}}}};
  Json& floor = tour["merger"]["floor_01"];
  Json a = Panorama("a.png", 1, 1), b = Panorama("b.png", 3, 2), c = Panorama("c.png", 4.5, 1.5);
  a["layout_complete"] = Layout(Local(room, 1, 1), Local(door, 1, 1));
  a["layout_visible"] = Layout(Local({{0, 0}, {4, 0}, {4, 3}}, 1, 1), Local(door, 1, 1));
  b["layout_complete"] = Layout(Local(room, 3, 2), Local(door, 3, 2));
  b["layout_raw"] = Layout(Local(room, 3, 2), {});
  c["layout_complete"] = Layout(Local(closet, 4.5, 1.5), Local(door_behind, 4.5, 1.5));
  c["is_ceiling_flat"] = false;
  c["is_inside"] = false;
  floor["complete_room_01"]["partial_room_01"]["pano_1"] = a;
  floor["complete_room_01"]["partial_room_02"]["pano_2"] = b;
  floor["complete_room_02"]["partial_room_03"]["pano_3"] = c;
  return tour;
}

class ZindTruthTest : public testing::Test {
 protected:
  std::string RefusalAfter(const std::function<void(Json&)>& change) {
    Json tour = Tour();
    change(tour);
    WriteJsonFile(temp / "zind_data.json", tour);
    return Refusal(temp.path());
  }
  TempFolder temp;
};

TEST_F(ZindTruthTest, RoomsAreTheCompleteRooms) {
  WriteJsonFile(temp / "zind_data.json", Tour());
  const GroundTruth truth = ReadGroundTruth(temp.path());
  ASSERT_THAT(truth.rooms, SizeIs(2));
  EXPECT_NEAR(Area(truth.rooms[0].region), 12, 1e-6);
  EXPECT_TRUE(Contains(truth.rooms[0].region[0], Eigen::Vector2d(3.9, -0.1)));
  EXPECT_NEAR(*truth.rooms[0].ceiling_z, 2.4, 1e-9);
  EXPECT_EQ(truth.rooms[1].ceiling_z, std::nullopt);
  EXPECT_NEAR(TotalLength(truth.walls), 14 - 0.8 + 3.8 - 0.8, 1e-6);
  ASSERT_THAT(truth.doors, SizeIs(1));  // one door seen from both sides
  EXPECT_NEAR(truth.doors[0][0].x(), (4 + 4 + 4.1) / 3, 1e-6);
}

TEST_F(ZindTruthTest, AViewHasItsVisibleLayoutElseTheRawOne) {
  WriteTestPicture(temp / "panos" / "a.png", 1);
  WriteJsonFile(temp / "zind_data.json", Tour());
  const GroundTruth truth = ReadGroundTruth(temp.path());
  ASSERT_THAT(truth.views, SizeIs(3));
  EXPECT_EQ(truth.views[0].picture, "a.png");
  EXPECT_EQ(truth.views[0].sha256, Sha256OfFile(temp / "panos" / "a.png"));
  EXPECT_NEAR(SignedArea(truth.views[0].visible_layout), 6, 1e-6);
  EXPECT_THAT(truth.views[0].doors, SizeIs(1));
  EXPECT_NEAR(truth.views[0].camera_height_m, 1.5, 1e-9);
  EXPECT_EQ(truth.views[1].sha256, "");
  EXPECT_NEAR(SignedArea(truth.views[1].visible_layout), 12, 1e-6);
  EXPECT_FALSE(truth.views[2].is_inside);
  EXPECT_TRUE(truth.views[2].visible_layout.empty());
}

TEST_F(ZindTruthTest, AnUnknownScaleFollowsTheCameraHeight) {
  Json tour = Tour();
  tour["scale_meters_per_coordinate"]["floor_01"] = nullptr;
  WriteJsonFile(temp / "zind_data.json", tour);
  EXPECT_NEAR(Area(ReadGroundTruth(temp.path()).rooms[0].region), 12, 1e-6);  // 1.5 m assumed
  EXPECT_NEAR(Area(ReadGroundTruth(temp.path(), 3).rooms[0].region), 48, 1e-6);
}

TEST_F(ZindTruthTest, RefusesWrongContent) {
  const auto layout = [](Json& j) -> Json& {
    return j["merger"]["floor_01"]["complete_room_01"]["partial_room_01"]["pano_1"]
            ["layout_complete"];
  };
  EXPECT_EQ(RefusalAfter([](Json&) {}), "");
  EXPECT_THAT(RefusalAfter([&](Json& j) { layout(j)["vertices"][0] = 1; }),
              HasSubstr("layout_complete of 'panos/a.png' is not a pair of numbers"));
  EXPECT_THAT(RefusalAfter([&](Json& j) { layout(j).erase("vertices"); }), HasSubstr("'vertices'"));
  EXPECT_THAT(RefusalAfter([&](Json& j) { layout(j)["doors"].erase(0); }),
              HasSubstr("doors of 'panos/a.png' are not three rows each"));
  WriteFileAtomic(temp / "zind_data.json", Tour().dump().substr(0, 400));
  EXPECT_THAT(Refusal(temp.path()), HasSubstr("no valid JSON"));
}

// ---- layout.obj

// A box 4 × 3 m, floor at −1, whose ceiling is level at 1.5 but for a strip of the given width that
// slopes down to 0.5.
std::string Room(double strip_m) {
  const std::string s = std::to_string(4 - strip_m);
  return "# mesh\nv 0 0 -1\nv 4 0 -1\nv 4 3 -1\nv 0 3 -1\n"
         "v 0 0 1.5\nv " +
         s + " 0 1.5\nv " + s +
         " 3 1.5\nv 0 3 1.5\nv 4 0 0.5\nv 4 3 0.5\n"
         "f 1 2 3 4\nf 5/1 6/2 7/3 8/4\nf -5//1 -2//1 -1//1 -4//1\nf 1 2 9 6 5\nf 4 3 10 7 8\n"
         "f 1 4 8 5\nf 2 3 10 9\n";
}

class ObjTruthTest : public testing::Test {
 protected:
  GroundTruth Read(const std::string& text) {
    WriteFileAtomic(temp / "layout.obj", text);
    return ReadGroundTruth(temp.path());
  }
  std::string RefusalOf(const std::string& text) {
    WriteFileAtomic(temp / "layout.obj", text);
    return Refusal(temp.path());
  }
  TempFolder temp;
};

TEST_F(ObjTruthTest, ThePlanIsTheProjectionOfTheMesh) {
  const GroundTruth truth = Read(Room(0.2));
  ASSERT_THAT(truth.rooms, SizeIs(1));
  ASSERT_THAT(truth.rooms[0].region, SizeIs(1));
  EXPECT_THAT(truth.rooms[0].region[0].outer, SizeIs(4));
  EXPECT_NEAR(Area(truth.rooms[0].region), 12, 1e-6);
  EXPECT_NEAR(TotalLength(truth.walls), 14, 1e-6);
  EXPECT_THAT(truth.views, testing::IsEmpty());
}

TEST_F(ObjTruthTest, TheCeilingHasAHeightWhereNinetyPercentAreLevel) {
  const GroundTruth level = Read(Room(0.2));  // 95 % level
  EXPECT_NEAR(*level.rooms[0].floor_z, -1, 1e-9);
  ASSERT_TRUE(level.rooms[0].ceiling_z.has_value());
  EXPECT_NEAR(*level.rooms[0].ceiling_z, 1.5, 1e-9);
  EXPECT_EQ(Read(Room(0.6)).rooms[0].ceiling_z, std::nullopt);  // 85 %
}

TEST_F(ObjTruthTest, CamerasComeFromThePosesBesideIt) {
  WriteTestPicture(temp / "a.png", 1);
  WriteJsonFile(temp / "transforms.json",
                EquirectangularTransforms({UprightFrame("a.png", 1, 1, 0.25)}));
  const GroundTruth truth = Read(Room(0.2));
  ASSERT_THAT(truth.views, SizeIs(1));
  EXPECT_EQ(truth.views[0].sha256, Sha256OfFile(temp / "a.png"));
  EXPECT_TRUE(truth.views[0].is_inside);
  EXPECT_NEAR(truth.views[0].camera_height_m, 1.25, 1e-9);
  EXPECT_NEAR(SignedArea(truth.views[0].visible_layout), 12, 1e-6);
}

TEST_F(ObjTruthTest, RefusesBrokenFiles) {
  EXPECT_THAT(RefusalOf(""), HasSubstr("has no faces"));
  EXPECT_THAT(RefusalOf("v 0 0 0\n"), HasSubstr("has no faces"));
  EXPECT_THAT(RefusalOf("v 0 0\n"), HasSubstr("a vertex is not three numbers (line 1)"));
  EXPECT_THAT(RefusalOf("v 0 nan 0\n"), HasSubstr("a vertex is not three numbers"));
  EXPECT_THAT(RefusalOf("v 0 1e99 0\n"), HasSubstr("out of range"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nf 1 1\n"), HasSubstr("fewer than three vertices (line 2)"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nf 1 2 3\n"), HasSubstr("a vertex that is not there"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nf 1 0 1\n"), HasSubstr("a vertex that is not there"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nf 1 x 1\n"), HasSubstr("has no vertex index"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nf 1 99999999999999999999 1\n"), HasSubstr("no vertex index"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nv 0 0 1\nv 0 1 0\nf 1 2 3\n"), HasSubstr("its plan is empty"));
  EXPECT_THAT(RefusalOf("v 0 0 0\nv 9e6 0 1\nv 0 9e6 0\nf 1 2 3\n"), HasSubstr("over 1 km wide"));
}

}  // namespace
}  // namespace enfilade
