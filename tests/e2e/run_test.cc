// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The main job on a small home of our own, and that nothing shakes its result: threads, kills,
// stops.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/geometry/boolean.h"
#include "tests/e2e/program.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Every file of a result but the manifest, which holds times, and the lock.
std::map<std::string, std::string> ResultFiles(const fs::path& output) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(output)) {
    const std::string name = entry.path().lexically_relative(output);
    if (entry.is_regular_file() && name != "manifest.json" && name != ".lock") {
      files[name] = ReadFile(entry.path());
    }
  }
  return files;
}

// Tells which files differ instead of printing them.
void ExpectSameFiles(const std::map<std::string, std::string>& a,
                     const std::map<std::string, std::string>& b) {
  for (const auto& [name, bytes] : a) {
    ASSERT_TRUE(b.contains(name)) << name;
    EXPECT_TRUE(b.at(name) == bytes) << name << " differs";
  }
  EXPECT_EQ(a.size(), b.size());
}

MultiPolygon2 RoomsOf(const Storey& storey) {
  MultiPolygon2 rooms;
  for (const Room& room : storey.rooms) rooms.push_back(room.polygon);
  return rooms;
}

class Run : public testing::Test {
 protected:
  // Makes the home and its result once for all tests.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    ASSERT_EQ(RunProgram({"synth", "-o", home(), "--preset", "room", "--width", "512"}).exit_code,
              0);
    const ProgramResult result = RunProgram({"run", home(), "-o", reference(), "--threads", "1"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path home() { return folder_->path() / "home"; }
  static fs::path reference() { return folder_->path() / "reference"; }
  // Beside the reference: scene.json names pictures relative to itself.
  static fs::path output() { return folder_->path() / "out"; }

  void SetUp() override { fs::remove_all(output()); }

  static ProgramResult RunHome(const ProgramConditions& conditions = {}) {
    return RunProgram({"run", home(), "-o", output()}, conditions);
  }

 private:
  static TempFolder* folder_;
};

TempFolder* Run::folder_ = nullptr;

TEST_F(Run, FindsTheRoom) {
  const ProgramResult result = RunProgram({"evaluate", reference(), "--truth", home()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json figures = ReadJsonFile(reference() / "evaluation.json");
  EXPECT_GE(figures.at("area_iou_gross").get<double>(), 0.93);
  EXPECT_LE(figures.at("wall_plan_to_truth_median_m").get<double>(), 0.05);
  EXPECT_TRUE(fs::exists(reference() / "overlay.png"));
  fs::remove(reference() / "evaluation.json");
  fs::remove(reference() / "overlay.png");
}

TEST_F(Run, TrueWallProfilesGiveTheRoomExactly) {
  const std::string plan = ReadFile(reference() / "floorplan.json");
  const ProgramResult result =
      RunProgram({"evaluate", reference(), "--truth", home(), "--perfect"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const fs::path folder = reference() / "perfect";
  const nlohmann::json figures = ReadJsonFile(folder / "evaluation.json");
  EXPECT_GE(figures.at("area_iou_net").get<double>(), 0.98);
  EXPECT_EQ(figures.at("room_f1_10cm").get<double>(), 1.0);
  for (const char* name : {"floorplan.json", "plan.svg", "overlay.png"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(ReadFile(reference() / "floorplan.json"), plan);
  fs::remove_all(folder);
}

TEST_F(Run, SaysWhyAWallIsThere) {
  const ProgramResult result = RunProgram({"why", reference(), "0"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* text : {"wall 0 of room 0", "±", "seen by", "pano_", "cost in metres"})
    EXPECT_THAT(result.out, HasSubstr(text));
  for (const char* name : {"why_0.svg", "why_0.png"}) {
    EXPECT_TRUE(fs::exists(reference() / name)) << name;
    fs::remove(reference() / name);
  }
  ExpectRefusal(RunProgram({"why", reference(), "9999"}), "has no wall 9999; the nearest is ");
  ExpectRefusal(RunProgram({"why", reference(), "0", "--storey", "3"}), "no storey 3");
}

TEST_F(Run, WritesWhatTheProtocolNames) {
  for (const char* name :
       {"scene.json", "structure/structure.json", "evidence/evidence.json", "floorplan.json",
        "plan.svg", "model.glb", "model.obj", "manifest.json"}) {
    EXPECT_TRUE(fs::exists(reference() / name)) << name;
  }
  const nlohmann::json manifest = ReadJsonFile(reference() / "manifest.json");
  ASSERT_EQ(manifest.at("stages").size(), 7u);
  for (const nlohmann::json& stage : manifest.at("stages")) {
    EXPECT_EQ(stage.at("outcome"), "done");
    EXPECT_GT(stage.at("peak_memory_mb").get<double>(), 10);
  }
}

TEST_F(Run, GivesTheSameBytesForTwoThreads) {
  ASSERT_EQ(RunProgram({"run", home(), "-o", output(), "--threads", "2"}).exit_code, 0);
  ExpectSameFiles(ResultFiles(output()), ResultFiles(reference()));
}

TEST_F(Run, DoesNothingTheSecondTime) {
  ASSERT_EQ(RunHome().exit_code, 0);
  const auto written = fs::last_write_time(output() / "structure/structure.json");
  const ProgramResult result = RunHome();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("export: up to date"));
  EXPECT_EQ(fs::last_write_time(output() / "structure/structure.json"), written);
}

TEST_F(Run, StagesOneByOneGiveTheSame) {
  ASSERT_EQ(RunProgram({"sfm", home(), "-o", output()}).exit_code, 0);
  for (const char* stage : {"structure", "evidence", "floorplan", "model", "export"}) {
    const ProgramResult result = RunProgram({stage, output()});
    ASSERT_EQ(result.exit_code, 0) << stage << result.err;
  }
  ExpectSameFiles(ResultFiles(output()), ResultFiles(reference()));
  EXPECT_THAT(RunHome().err, HasSubstr("structure: up to date"));
}

// The files whose appearance tells how far a run has come.
class KilledRun : public Run, public testing::WithParamInterface<const char*> {};

TEST_P(KilledRun, ResumesToTheSameBytes) {
  const fs::path sign = output() / GetParam();
  const ProgramResult killed =
      RunHome({.signal_when = [&] { return fs::exists(sign); }, .signal = SIGKILL});
  EXPECT_EQ(killed.signal, SIGKILL);
  const ProgramResult resumed = RunHome();
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ExpectSameFiles(ResultFiles(output()), ResultFiles(reference()));
}

INSTANTIATE_TEST_SUITE_P(Anywhere, KilledRun,
                         testing::Values(".lock", "scene.json", "structure/profile_0000.bin",
                                         "structure/structure.json", "evidence/storey_0.bin",
                                         "floorplan.json", "model.obj"));

TEST_F(Run, StopsOnASignalAndSaysHowToResume) {
  const fs::path sign = output() / "scene.json";
  const ProgramResult stopped =
      RunHome({.signal_when = [&] { return fs::exists(sign); }, .signal = SIGINT});
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("run the same command again to resume"));
  EXPECT_FALSE(fs::exists(output() / "floorplan.json"));
  ASSERT_EQ(RunHome().exit_code, 0);
  ExpectSameFiles(ResultFiles(output()), ResultFiles(reference()));
}

TEST_F(Run, JsonLogHasOneObjectALine) {
  const ProgramResult result = RunProgram({"run", home(), "-o", output(), "--log-json"});
  EXPECT_EQ(result.exit_code, 0);
  size_t start = 0, num_lines = 0;
  for (size_t end; (end = result.err.find('\n', start)) != std::string::npos; start = end + 1) {
    EXPECT_TRUE(nlohmann::json::parse(result.err.substr(start, end - start)).contains("level"));
    ++num_lines;
  }
  EXPECT_GE(num_lines, 6u);
}

// Judged storey by storey: evaluate lays them on one another.
TEST(RunStoreys, FindsBothStoreysOfAFlat) {
  const TempFolder folder;
  const ProgramResult made = RunProgram(
      {"synth", "-o", folder / "home", "--seed", "2", "--home.storeys", "2", "--home.rooms", "3",
       "--home.furniture", "0", "--width", "320", "--pictures.render.light_cell_m", "0.1",
       "--pictures.render.gather_rays", "32", "--pictures.render.bounces", "2"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("of 6 rooms on 2 storeys"));
  const ProgramResult run = RunProgram({"run", folder / "home", "-o", folder / "out"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_EQ(RunProgram({"evaluate", folder / "out", "--truth", folder / "home"}).exit_code, 0);
  EXPECT_GE(ReadJsonFile(folder / "out/evaluation.json").at("area_iou_gross").get<double>(), 0.95);

  const Floorplan plan = ReadFloorplanJson(folder / "out/floorplan.json"),
                  truth = ReadFloorplanJson(folder / "home/truth/floorplan.json");
  ASSERT_EQ(truth.storeys.size(), 2u);
  ASSERT_EQ(plan.storeys.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(plan.storeys[i].rooms.size(), 3u);
    EXPECT_NEAR(plan.storeys[i].floor_z, truth.storeys[i].floor_z, 0.1);
    const Rigid3 truth_from_plan = truth.home_from_world * plan.home_from_world.Inverse();
    MultiPolygon2 found = RoomsOf(plan.storeys[i]);
    for (Polygon2& room : found) {
      for (Eigen::Vector2d& p : room.outer)
        p = (truth_from_plan * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
    }
    EXPECT_GE(AreaIou(Union(found), RoomsOf(truth.storeys[i])), 0.95);
  }
  for (const PlanCamera& camera : plan.cameras) {
    const auto other = std::find_if(truth.cameras.begin(), truth.cameras.end(),
                                    [&](const PlanCamera& c) { return c.sha256 == camera.sha256; });
    ASSERT_NE(other, truth.cameras.end());
    EXPECT_EQ(camera.storey_idx, other->storey_idx);
  }
}

// From seed to video; `run` does not take it yet, and says what it takes.
TEST(Synth, MakesAVideoThatRunRefuses) {
  const TempFolder folder;
  const ProgramResult made = RunProgram({"synth",
                                         "-o",
                                         folder / "home",
                                         "--preset",
                                         "walk",
                                         "--home.rooms",
                                         "3",
                                         "--home.furniture",
                                         "0",
                                         "--width",
                                         "64",
                                         "--pictures.kind",
                                         "video",
                                         "--pictures.frames_per_second",
                                         "0.5",
                                         "--pictures.render.light_cell_m",
                                         "0.5",
                                         "--pictures.render.gather_rays",
                                         "8",
                                         "--pictures.render.bounces",
                                         "0",
                                         "--pictures.render.samples_per_pixel",
                                         "1"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_GT(fs::file_size(folder / "home/video.avi"), 5000u);
  EXPECT_TRUE(fs::exists(folder / "home/truth/frames.csv"));
  ExpectRefusal(RunProgram({"run", folder / "home", "-o", folder / "out"}), "has no pictures");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Synth, RefusesWhatDoesNotGoTogether) {
  const TempFolder folder;
  const auto refused = [&](std::vector<std::string> options, const std::string& text) {
    options.insert(options.begin(), {"synth", "-o", folder / "home"});
    ExpectRefusal(RunProgram(options), text);
    EXPECT_FALSE(fs::exists(folder / "home"));
  };
  refused({"--pictures.kind", "video"}, "give the preset walk");
  refused({"--preset", "walk", "--home.storeys", "2"}, "give the preset flat or tour");
  refused({"--preset", "building", "--home.storeys", "3"}, "give the preset flat or tour");
  refused({"--home.storeys", "4"}, "storeys");
  refused({"--preset", "building", "--home.rooms", "201"}, "have 20 to 200");
  refused({"--preset", "tour", "--home.rooms", "200"}, "have 5 to 8");
}

TEST(Sfm, TakesPerspectiveViews) {
  const TempFolder folder;
  const ProgramResult made =
      RunProgram({"synth", "-o", folder / "home", "--preset", "room", "--width", "256",
                  "--pictures.kind", "perspective", "--pictures.render.light_cell_m", "0.3",
                  "--pictures.render.gather_rays", "16"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult read = RunProgram({"sfm", folder / "home", "-o", folder / "out"});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const nlohmann::json scene = ReadJsonFile(folder / "out/scene.json");
  ASSERT_GE(scene.at("views").size(), 8u);
  EXPECT_EQ(scene.at("views").size() % 8, 0u);
  for (const nlohmann::json& view : scene.at("views"))
    EXPECT_EQ(view.at("camera").at("model"), "pinhole");
}

}  // namespace
}  // namespace enfilade
