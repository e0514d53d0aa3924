// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/floorplan_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/floorplan/vertex_dial.h"
#include "enfilade/geometry/angles.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

// Two rooms with a door between them; the first has a pillar.
Floorplan TwoRooms() {
  Floorplan plan;
  plan.home_from_world = {RotationZ(DegToRad(10)), Eigen::Vector3d(1, 2, 0)};
  Storey storey;
  storey.id = 3;
  storey.floor_z = -0.1;
  storey.rooms.push_back(
      {7, {ParseRing("0,0 4,0 4,3 0,3"), {ParseRing("1,1 1,2 2,2 2,1")}}, -0.1, 2.4, 0.25});
  storey.rooms.push_back({8, {ParseRing("4.1,0 6,0 6,3 4.1,3"), {}}, -0.1, 2.5, 0.5, false});
  storey.walls.push_back({1, {4, 0}, {4, 3}, 7, 8, 0.1, true, WallSeen::kPartly, 0.02});
  storey.walls.push_back({2, {0, 0}, {4, 0}, 7, std::nullopt, 0.2, false, WallSeen::kSeen, 0.01});
  storey.openings.push_back({5, OpeningKind::kDoor, 1, {4, 1}, {4, 1.8}, -0.1, 1.9, 7, 8});
  storey.openings.push_back(
      {6, OpeningKind::kWindow, 2, {1, 0}, {2, 0}, 0.8, 1.9, 7, std::nullopt});
  plan.storeys.push_back(storey);
  plan.cameras.push_back({"küche.jpg",
                          std::string(64, 'a'),
                          0,
                          1,
                          true,
                          {RotationZ(0.3), Eigen::Vector3d(1.5, 0.5, 1.4)}});
  return plan;
}

class FloorplanJsonTest : public testing::Test {
 protected:
  // The refusal of the file after `change`.
  std::string RefusalAfter(const std::function<void(Json&)>& change) {
    WriteFloorplanJson(file, TwoRooms(), Json::object());
    Json json = ReadJsonFile(file);
    change(json);
    WriteJsonFile(file, json);
    return Refusal();
  }
  std::string Refusal() {
    try {
      (void)ReadFloorplanJson(file);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }

  TempFolder temp;
  std::filesystem::path file = temp / "floorplan.json";
};

TEST_F(FloorplanJsonTest, WhatIsWrittenIsReadBack) {
  const Floorplan plan = TwoRooms();
  WriteFloorplanJson(file, plan, {{"version", "1.2"}});
  const Floorplan read = ReadFloorplanJson(file);
  EXPECT_TRUE(read.home_from_world.Matrix().isApprox(plan.home_from_world.Matrix(), 1e-8));
  ASSERT_EQ(read.storeys.size(), 1U);
  const Storey& storey = read.storeys[0];
  EXPECT_EQ(storey.id, 3);
  EXPECT_EQ(storey.floor_z, -0.1);
  ASSERT_EQ(storey.rooms.size(), 2U);
  EXPECT_EQ(RingToText(storey.rooms[0].polygon.outer), "0,0 4,0 4,3 0,3");
  ASSERT_EQ(storey.rooms[0].polygon.holes.size(), 1U);
  EXPECT_EQ(Area(storey.rooms[0].polygon), 11);
  EXPECT_EQ(storey.rooms[1].ceiling_z, 2.5);
  EXPECT_EQ(storey.rooms[1].area_sigma_m2, 0.5);
  EXPECT_TRUE(storey.rooms[0].has_level_ceiling);
  EXPECT_FALSE(storey.rooms[1].has_level_ceiling);
  ASSERT_EQ(storey.walls.size(), 2U);
  EXPECT_EQ(storey.walls[0].other_room_id, 8);
  EXPECT_EQ(storey.walls[1].other_room_id, std::nullopt);
  EXPECT_TRUE(storey.walls[0].is_thickness_measured);
  EXPECT_FALSE(storey.walls[1].is_thickness_measured);
  EXPECT_EQ(storey.walls[0].seen, WallSeen::kPartly);
  EXPECT_EQ(storey.walls[0].sigma_m, 0.02);
  ASSERT_EQ(storey.openings.size(), 2U);
  EXPECT_EQ(storey.openings[0].kind, OpeningKind::kDoor);
  EXPECT_EQ(storey.openings[0].b, Eigen::Vector2d(4, 1.8));
  EXPECT_EQ(storey.openings[1].wall_id, 2);
  ASSERT_EQ(read.cameras.size(), 1U);
  EXPECT_EQ(read.cameras[0].picture, "küche.jpg");
  EXPECT_EQ(read.cameras[0].component_idx, 1);
  EXPECT_TRUE(read.cameras[0].is_inferred);
  EXPECT_TRUE(read.cameras[0].world_from_cam.Matrix().isApprox(
      plan.cameras[0].world_from_cam.Matrix(), 1e-8));
}

TEST_F(FloorplanJsonTest, WritingWhatWasReadGivesTheSameBytes) {
  WriteFloorplanJson(file, TwoRooms(), {{"version", "1.2"}});
  const std::string first = ReadFile(file);
  WriteFloorplanJson(file, ReadFloorplanJson(file), {{"version", "1.2"}});
  EXPECT_EQ(ReadFile(file), first);
}

// The first room may also have six corners, or eight with a hole.
Floorplan WithCurve() {
  Floorplan plan = TwoRooms();
  const auto choice = [](double cost_m, const Polygon2& polygon) {
    OutlineChoice outline{cost_m, polygon, {}, {}};
    outline.seen.assign(static_cast<size_t>(outline.NumVertices()), WallSeen::kSeen);
    outline.seen.front() = WallSeen::kInferred;
    outline.sigma_m.assign(outline.seen.size(), 0.02);
    return outline;
  };
  plan.storeys[0].rooms[0].curve = {
      choice(1.5, {ParseRing("0,0 4,0 4,3 0,3"), {}}),
      choice(0.25, {ParseRing("0,0 4,0 4,3 2,3 2,2 0,2"), {}}),
      choice(0, {ParseRing("0,0 4,0 4,3 0,3"), {ParseRing("1,1 1,2 2,2 2,1")}})};
  return plan;
}

TEST_F(FloorplanJsonTest, CurvesAreReadBack) {
  const Floorplan plan = WithCurve();
  WriteFloorplanJson(file, plan, Json::object());
  const std::string bytes = ReadFile(file);
  const Floorplan read = ReadFloorplanJson(file);
  const std::vector<OutlineChoice>& curve = read.storeys[0].rooms[0].curve;
  ASSERT_EQ(curve.size(), 3U);
  for (size_t i = 0; i < curve.size(); ++i) {
    const OutlineChoice& expected = plan.storeys[0].rooms[0].curve[i];
    EXPECT_EQ(curve[i].cost_m, expected.cost_m);
    EXPECT_EQ(curve[i].polygon.outer, expected.polygon.outer);
    EXPECT_EQ(curve[i].polygon.holes, expected.polygon.holes);
    EXPECT_EQ(curve[i].seen, expected.seen);
    EXPECT_EQ(curve[i].sigma_m, expected.sigma_m);
  }
  EXPECT_TRUE(read.storeys[0].rooms[1].curve.empty());
  WriteFloorplanJson(file, read, Json::object());
  EXPECT_EQ(ReadFile(file), bytes);
  const Json json = ReadJsonFile(file)["storeys"][0]["rooms"][0]["curve"];
  EXPECT_EQ(json[1]["vertices"], 6);
  EXPECT_EQ(json[1]["area_m2"], 10);
  EXPECT_EQ(json[0]["area_change_m2"], 2);
  EXPECT_TRUE(json[2]["area_change_m2"].is_null());
  EXPECT_EQ(json[1]["seen"], "isssss");
}

TEST_F(FloorplanJsonTest, RefusesBrokenCurves) {
  const auto refusal = [&](const std::function<void(Json&)>& change) {
    WriteFloorplanJson(file, WithCurve(), Json::object());
    Json json = ReadJsonFile(file);
    change(json["storeys"][0]["rooms"][0]["curve"]);
    WriteJsonFile(file, json);
    return Refusal();
  };
  EXPECT_EQ(refusal([](Json&) {}), "");
  EXPECT_THAT(refusal([](Json& curve) { curve = "none"; }), HasSubstr("curve"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0] = 4; }), HasSubstr("vertices"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0].erase("vertices"); }), HasSubstr("vertices"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["vertices"] = 6; }), HasSubstr("another number"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["seen"] = "sss"; }), HasSubstr("another number"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["seen"] = "ssqs"; }), HasSubstr("letter"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["sigma_m"] = Json::array(); }),
              HasSubstr("another number"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["sigma_m"][2] = "x"; }), HasSubstr("sigma_m"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["outline"].erase(0); }), HasSubstr("no outline"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["outline"] = {0, 0, 0, 3, 4, 3, 4, 0}; }),
              HasSubstr("direction"));
  EXPECT_THAT(refusal([](Json& curve) { curve[2]["holes"][0] = {1, 1, 2, 1, 2, 2, 1, 2}; }),
              HasSubstr("direction"));
  EXPECT_THAT(refusal([](Json& curve) { curve[0]["cost_m"] = nullptr; }), HasSubstr("cost_m"));
  EXPECT_THAT(refusal([](Json& curve) { curve[1] = curve[0]; }), HasSubstr("does not ascend"));
}

// The dial stands elsewhere.
Floorplan Dialled() {
  Floorplan plan = WithCurve();
  plan.drawn_storeys = plan.storeys;
  plan.drawn_storeys[0].rooms[0].curve.clear();
  plan.storeys[0].openings.clear();
  plan.dial = {8, 1.5, 1.25, 2};
  return plan;
}

TEST_F(FloorplanJsonTest, TheDialIsReadBack) {
  WriteFloorplanJson(file, Dialled(), Json::object());
  const std::string bytes = ReadFile(file);
  const Floorplan read = ReadFloorplanJson(file);
  ASSERT_TRUE(read.dial);
  EXPECT_EQ(read.dial->num_vertices, 8);
  EXPECT_EQ(read.dial->cost_m, 1.5);
  EXPECT_EQ(read.dial->bound_m, 1.25);
  EXPECT_EQ(read.dial->num_openings_dropped, 2);
  ASSERT_EQ(read.drawn_storeys.size(), 1U);
  EXPECT_EQ(read.drawn_storeys[0].openings.size(), 2U);
  WriteFloorplanJson(file, read, Json::object());
  EXPECT_EQ(ReadFile(file), bytes);
  WriteFloorplanJson(file, TwoRooms(), Json::object());
  EXPECT_FALSE(ReadJsonFile(file).contains("dial"));
  EXPECT_FALSE(ReadJsonFile(file).contains("drawn_storeys"));
}

// Two rooms with a wall between them, none of their coordinates round; the first has an alcove with
// a door, and may be without it.
Floorplan WithAlcove() {
  const double x = 1.0 / 3, wall = 10 + 1.0 / 7;
  const auto at = [&](double left, double right, const std::string& text) {
    Ring2 ring = ParseRing(text);
    for (Eigen::Vector2d& p : ring) p.x() = p.x() == 0 ? left : p.x() == 10 ? right : p.x() * x;
    return ring;
  };
  const OutlineChoice drawn{0,
                            {at(x, wall, "0,0 10,0 10,3 8,3 8,3.3 4,3.3 4,3 0,3"), {}},
                            std::vector<WallSeen>(8, WallSeen::kSeen),
                            std::vector<double>(8, 0.02)};
  const OutlineChoice simple{2.5,
                             {at(x, wall, "0,0 10,0 10,3 0,3"), {}},
                             std::vector<WallSeen>(4, WallSeen::kPartly),
                             std::vector<double>(4, 0.02)};
  const OutlineChoice other{0,
                            {at(x, wall, "0,3.4123456789 10,3.4123456789 10,6 0,6"), {}},
                            std::vector<WallSeen>(4, WallSeen::kSeen),
                            std::vector<double>(4, 0.03)};
  Floorplan plan;
  Storey& storey = plan.storeys.emplace_back();
  for (const int id : {0, 1}) {
    Room& room = storey.rooms.emplace_back();
    room.id = id;
    room.ceiling_z = 2.4;
  }
  TakeOutline(drawn, 0.1 + x / 1000, storey.rooms[0], storey);
  TakeOutline(other, 0.1, storey.rooms[1], storey);
  storey.rooms[0].curve = {simple, drawn};
  for (Wall& wall_face : storey.walls) wall_face.length_sigma_m = x / 10;
  storey.walls[4].other_room_id = 1;
  storey.openings.push_back({0, OpeningKind::kDoor, 4, {7.5 * x, 3.3}, {5.5 * x, 3.3}, 0, 2, 0, 1});
  return plan;
}

TEST_F(FloorplanJsonTest, TheDialTurnsFromMemoryAsFromTheFile) {
  const auto bytes_of = [&](const Floorplan& plan) {
    WriteFloorplanJson(file, plan, Json::object());
    return ReadFile(file);
  };
  const Floorplan plan = WithAlcove();
  for (const int number : {4, 8}) {
    const std::string from_memory = bytes_of(*PlanWithVertices(plan, number, 0.45));
    (void)bytes_of(plan);
    EXPECT_EQ(bytes_of(*PlanWithVertices(ReadFloorplanJson(file), number, 0.45)), from_memory);
    // … and wherever the dial stood.
    (void)bytes_of(*PlanWithVertices(plan, 12 - number, 0.45));
    EXPECT_EQ(bytes_of(*PlanWithVertices(ReadFloorplanJson(file), number, 0.45)), from_memory);
  }
}

TEST_F(FloorplanJsonTest, RefusesABrokenDial) {
  const auto refusal = [&](const std::function<void(Json&)>& change) {
    WriteFloorplanJson(file, Dialled(), Json::object());
    Json json = ReadJsonFile(file);
    change(json);
    WriteJsonFile(file, json);
    return Refusal();
  };
  EXPECT_EQ(refusal([](Json&) {}), "");
  EXPECT_THAT(refusal([](Json& json) { json["dial"] = 4; }), HasSubstr("vertices"));
  EXPECT_THAT(refusal([](Json& json) { json["dial"].erase("bound_m"); }), HasSubstr("bound_m"));
  EXPECT_THAT(refusal([](Json& json) { json["drawn_storeys"] = 1; }), HasSubstr("drawn_storeys"));
  EXPECT_THAT(refusal([](Json& json) {
                const Json storey = json["drawn_storeys"][0];
                json["drawn_storeys"].push_back(storey);
              }),
              HasSubstr("other rooms"));
  EXPECT_THAT(refusal([](Json& json) { json["drawn_storeys"][0]["rooms"].erase(1); }),
              HasSubstr("rooms"));
  EXPECT_THAT(refusal([](Json& json) {
                json["drawn_storeys"][0]["walls"] = Json::array();
                json["drawn_storeys"][0]["openings"] = Json::array();
              }),
              HasSubstr("no walls"));
}

TEST_F(FloorplanJsonTest, HoldsTheKeysOfTheFormat) {
  WriteFloorplanJson(file, TwoRooms(), {{"version", "1.2"}});
  const Json json = ReadJsonFile(file);
  EXPECT_EQ(json["format"], "enfilade-floorplan");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["home_from_world"].size(), 16U);
  EXPECT_EQ(json["provenance"]["version"], "1.2");
  const Json& storey = json["storeys"][0];
  EXPECT_EQ(storey["rooms"][0]["area_m2"], 11);
  EXPECT_EQ(storey["walls"][1]["rooms"], Json({7, nullptr}));
  EXPECT_EQ(storey["walls"][0]["thickness"], "measured");
  EXPECT_EQ(storey["walls"][0]["seen"], "partly");
  EXPECT_EQ(storey["openings"][1]["kind"], "window");
  EXPECT_EQ(json["cameras"][0]["world_from_cam"][3], 1.5);
}

TEST_F(FloorplanJsonTest, ReadsTheLeastThatAnotherProgramMayWrite) {
  WriteFileAtomic(file, R"({"format": "enfilade-floorplan", "version": 1,
    "home_from_world": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
    "storeys": [{"id": 0, "floor_z": 0.5, "rooms": [
      {"id": 0, "polygon": [[0,0], [0,2], [2,2], [2,0]], "ceiling_z": 3}]}]})");
  const Floorplan plan = ReadFloorplanJson(file);
  const Room& room = plan.storeys.at(0).rooms.at(0);
  EXPECT_GT(SignedArea(room.polygon.outer), 0);  // turned counter-clockwise
  EXPECT_EQ(room.floor_z, 0.5);
}

TEST_F(FloorplanJsonTest, RefusesBrokenFiles) {
  EXPECT_THAT(Refusal(), HasSubstr("cannot be opened"));
  WriteFileAtomic(file, "");
  EXPECT_THAT(Refusal(), HasSubstr("is empty"));
  WriteFloorplanJson(file, TwoRooms(), Json::object());
  const std::string whole = ReadFile(file);
  for (size_t size = 0; size < whole.size() - 2; size += 113) {
    WriteFileAtomic(file, whole.substr(0, size));
    EXPECT_THAT(Refusal(), HasSubstr("is no valid JSON")) << size;
  }
  WriteFileAtomic(file, "[1, 2]");
  EXPECT_THAT(Refusal(), HasSubstr("key 'format' is missing"));
}

TEST_F(FloorplanJsonTest, RefusesWrongContent) {
  using J = Json&;
  EXPECT_THAT(RefusalAfter([](J j) { j["format"] = "x"; }), HasSubstr("no floorplan.json"));
  EXPECT_THAT(RefusalAfter([](J j) { j["version"] = 2; }), HasSubstr("unknown version"));
  EXPECT_THAT(RefusalAfter([](J j) { j.erase("storeys"); }), HasSubstr("'storeys' is missing"));
  EXPECT_THAT(RefusalAfter([](J j) { j["home_from_world"].erase(0); }), HasSubstr("4 × 4"));
  EXPECT_THAT(RefusalAfter([](J j) { j["home_from_world"][0] = 2; }), HasSubstr("no rotation"));
  EXPECT_THAT(RefusalAfter([](J j) { j["home_from_world"][0] = nullptr; }),
              HasSubstr("not a number"));
  EXPECT_THAT(RefusalAfter([](J j) { j["storeys"][0]["id"] = 1e12; }), HasSubstr("'id'"));
  EXPECT_THAT(RefusalAfter([](J j) {
                j["storeys"][0]["rooms"][0]["polygon"] = {{0, 0}, {1, 0}};
              }),
              HasSubstr("fewer than three points"));
  EXPECT_THAT(RefusalAfter([](J j) { j["storeys"][0]["rooms"][0]["polygon"][0] = {0}; }),
              HasSubstr("pair of numbers"));
  EXPECT_THAT(RefusalAfter([](J j) {
                j["storeys"][0]["walls"][0]["rooms"] = {7, 99};
              }),
              HasSubstr("[7,99]"));
  EXPECT_THAT(RefusalAfter([](J j) { j["storeys"][0]["walls"][0]["seen"] = "maybe"; }),
              HasSubstr("seen, partly, inferred"));
  EXPECT_THAT(RefusalAfter([](J j) { j["storeys"][0]["openings"][0]["kind"] = "hatch"; }),
              HasSubstr("door, opening, window"));
  EXPECT_THAT(RefusalAfter([](J j) { j["storeys"][0]["openings"][0]["wall"] = 40; }),
              HasSubstr("wall 40, which is not there"));
  EXPECT_THAT(RefusalAfter([](J j) { j["cameras"][0]["storey"] = 1; }), HasSubstr("not there"));
  EXPECT_THAT(RefusalAfter([](J j) { j["cameras"][0]["picture"] = 1; }), HasSubstr("a string"));
}

TEST_F(FloorplanJsonTest, RefusesNumbersTooLargeForADouble) {
  WriteFloorplanJson(file, TwoRooms(), Json::object());
  std::string text = ReadFile(file);
  text.replace(text.find("2.4"), 3, "1e999");
  WriteFileAtomic(file, text);
  EXPECT_THAT(Refusal(), HasSubstr("floorplan.json"));
}

}  // namespace
}  // namespace enfilade
