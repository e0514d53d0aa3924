// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/connection_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "tests/exchange/connection_scenes.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double kRounding = 0.6e-4;  // of the figures in connections.json

Json WrittenJson(const ReportedScene& reported) {
  TempFolder folder;
  WriteConnectionReport(folder.path(), reported.scene, reported.Report());
  return ReadJsonFile(folder / "connections.json");
}

TEST(WriteConnectionReport, JsonTellsWhatTheSceneAndThePairsAre) {
  const Json json = WrittenJson(MakeThreeRooms());
  EXPECT_EQ(json["format"], "enfilade-connections");
  EXPECT_EQ(json["version"], 1);
  ASSERT_EQ(json["views"].size(), 3u);
  const Json& kitchen = json["views"][1];
  EXPECT_EQ(kitchen["picture"], "kitchen.jpg");
  EXPECT_EQ(kitchen["component"], 0);
  EXPECT_EQ(kitchen["num_features"], 2500);
  EXPECT_EQ(kitchen["num_points"], 5);
  EXPECT_EQ(json["views"][0]["num_points"], 2);
  EXPECT_EQ(kitchen["num_connections"], 1);
  EXPECT_EQ(kitchen["position_m"], Json({4.0, 6.0, 1.5}));
  EXPECT_NEAR(kitchen["yaw_deg"], -30, kRounding);
  EXPECT_NEAR(kitchen["tilt_deg"], 0, kRounding);
  EXPECT_EQ(kitchen["inferred"], false);
  ASSERT_EQ(json["components"].size(), 2u);
  EXPECT_EQ(json["components"][0]["num_pictures"], 2);
  EXPECT_EQ(json["components"][0]["pictures"], Json({"hall.jpg", "kitchen.jpg"}));
  EXPECT_EQ(json["components"][0]["extent_m"], Json({3.0, 4.0}));
  EXPECT_EQ(json["components"][1]["extent_m"], Json({0.0, 0.0}));
  // The pair with seven matches is left out.
  ASSERT_EQ(json["pairs"].size(), 2u);
  EXPECT_EQ(json["num_pairs_left_out"], 1);
  EXPECT_EQ(json["num_pairs_not_matched"], 0);
  const Json& tie = json["pairs"][0];
  EXPECT_EQ(tie["views"], Json({0, 1}));
  EXPECT_EQ(tie["pictures"], Json({"hall.jpg", "kitchen.jpg"}));
  EXPECT_EQ(tie["verdict"], "accepted");
  EXPECT_EQ(tie["num_matches"], 120);
  EXPECT_EQ(tie["num_inliers"], 60);
  EXPECT_NEAR(tie["parallax_deg"], 12, kRounding);
  EXPECT_NEAR(tie["distance_m"], 5, kRounding);
  EXPECT_NEAR(tie["log10_chance"], -24, kRounding);
  const Json& refused = json["pairs"][1];
  EXPECT_EQ(refused["verdict"], "chance");
  for (const char* key : {"distance_m", "yaw_miss_deg", "direction_miss_deg"}) {
    EXPECT_TRUE(refused[key].is_null()) << key;
  }
}

TEST(WriteConnectionReport, MissesAreThoseOfThePairAgainstTheScene) {
  ReportedScene reported = MakeThreeRooms();
  for (const double turn_deg : {0.0, 3.0, -170.0}) {
    reported.pairs.clear();
    PanoPair& pair = AddPair(reported, 0, 1, PairVerdict::kAccepted, 120, 60);
    pair.a_from_b = RotationZ(DegToRad(turn_deg)) * pair.a_from_b;
    pair.direction = RotationZ(DegToRad(0.5 * turn_deg)) * pair.direction;
    const Json json = WrittenJson(reported);
    EXPECT_NEAR(json["pairs"][0]["yaw_miss_deg"], turn_deg, kRounding);
    EXPECT_NEAR(json["pairs"][0]["direction_miss_deg"], std::abs(0.5 * turn_deg), kRounding);
  }
}

TEST(WriteConnectionReport, PairsThatWereNotMatchedAreCountedAndNotListed) {
  ReportedScene reported = MakeThreeRooms();
  reported.pairs.resize(1);
  const Json json = WrittenJson(reported);
  EXPECT_EQ(json["pairs"].size(), 1u);
  EXPECT_EQ(json["num_pairs_not_matched"], 2);
}

TEST(WriteConnectionReport, TiltIsBetweenTheUpwardAxes) {
  ReportedScene reported = MakeThreeRooms();
  Rigid3& pose = reported.scene.views[0].world_from_cam;
  // About the camera's x axis: the picture's centre keeps its azimuth.
  pose.rotation =
      pose.rotation * Eigen::AngleAxisd(DegToRad(7), Vector3d::UnitX()).toRotationMatrix();
  const Json json = WrittenJson(reported);
  EXPECT_NEAR(json["views"][0]["tilt_deg"], 7, kRounding);
  EXPECT_NEAR(json["views"][0]["yaw_deg"], 90, kRounding);
}

TEST(WriteConnectionReport, FiguresThatAreNoNumbersAreNull) {
  ReportedScene reported = MakeThreeRooms();
  reported.pairs[0].log10_chance = -std::numeric_limits<double>::infinity();
  EXPECT_TRUE(WrittenJson(reported)["pairs"][0]["log10_chance"].is_null());
}

TEST(WriteConnectionReport, WritesTheSameBytesTwiceAndForAnyOrderOfPairs) {
  TempFolder folder;
  ReportedScene reported = MakeReportedScene({20, 8, 4});
  WriteConnectionReport(folder / "a" / "b", reported.scene, reported.Report());
  std::ranges::reverse(reported.pairs);
  WriteConnectionReport(folder / "c", reported.scene, reported.Report());
  for (const char* name : {"connections.json", "connections.svg", "connections.html"}) {
    EXPECT_EQ(ReadFile(folder / "a" / "b" / name), ReadFile(folder / "c" / name)) << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "c"), fs::directory_iterator()), 3);
}

TEST(WriteConnectionReport, TellsNoPathsAndNoHashes) {
  TempFolder folder;
  ReportedScene reported = MakeThreeRooms();
  for (View& view : reported.scene.views) {
    view.path = "/secret/place/" + view.picture;
    view.sha256 = "0123abcd";
  }
  WriteConnectionReport(folder.path(), reported.scene, reported.Report());
  for (const char* name : {"connections.json", "connections.svg", "connections.html"}) {
    const std::string bytes = ReadFile(folder / name);
    EXPECT_THAT(bytes, Not(HasSubstr("secret"))) << name;
    EXPECT_THAT(bytes, Not(HasSubstr("0123abcd"))) << name;
    EXPECT_THAT(bytes, Not(HasSubstr(folder.path().string()))) << name;
  }
}

TEST(WriteConnectionReport, BrokenFolderIsAnIoError) {
  TempFolder folder;
  std::ofstream(folder / "file") << "x";
  const ReportedScene reported = MakeThreeRooms();
  EXPECT_THROW(WriteConnectionReport(folder / "file", reported.scene, reported.Report()), IoError);
  fs::create_directories(folder / "busy" / "connections.svg" / "x");
  EXPECT_THROW(WriteConnectionReport(folder / "busy", reported.scene, reported.Report()), IoError);
}

TEST(WriteConnectionReport, WrongIndicesAreBugs) {
  const ReportedScene good = MakeThreeRooms();
  ReportedScene reported = good;
  reported.pairs[0].b_idx = 3;
  EXPECT_THROW((void)FormatConnectionsSvg(reported.scene, reported.Report()), std::logic_error);
  reported = good;
  std::swap(reported.pairs[0].a_idx, reported.pairs[0].b_idx);
  EXPECT_THROW((void)FormatConnectionsSvg(reported.scene, reported.Report()), std::logic_error);
  reported = good;
  reported.num_features.pop_back();
  EXPECT_THROW((void)FormatConnectionsSvg(reported.scene, reported.Report()), std::logic_error);
  reported = good;
  reported.scene.points[0].view_idx = {3};
  EXPECT_THROW((void)FormatConnectionsSvg(reported.scene, reported.Report()), std::logic_error);
  reported = good;
  reported.scene.views[1].world_from_cam.translation.x() = std::nan("");
  EXPECT_THROW((void)FormatConnectionsSvg(reported.scene, reported.Report()), std::logic_error);
}

}  // namespace
}  // namespace enfilade
