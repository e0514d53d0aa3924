// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// `evaluate --self`: a run checked against itself, without any truth.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "tests/e2e/program.h"
#include "tests/e2e/small_room.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

class SelfCheck : public testing::Test {
 protected:
  // A room with three panoramas and its result, made once for all tests.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    WriteSmallRoom(home());
    RunHome(home(), reference());
    const ProgramResult result = Check(reference(), {"--threads", "1"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    ASSERT_THAT(result.out, HasSubstr("self_score"));
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static const fs::path& folder() { return folder_->path(); }
  static fs::path home() { return folder_->path() / "home"; }
  static fs::path reference() { return folder_->path() / "reference"; }
  static fs::path output() { return folder_->path() / "out"; }
  static fs::path Plan(const fs::path& result, int view) {
    return result / "leave_one_out" / ("plan_000" + std::to_string(view) + ".json");
  }

  static void RunHome(const fs::path& pictures, const fs::path& result) {
    const ProgramResult run =
        RunProgram({"run", pictures, "-o", result, "--structure.num_columns", "128"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  static ProgramResult Check(const fs::path& result, const std::vector<std::string>& more = {},
                             const ProgramConditions& conditions = {}) {
    std::vector<std::string> arguments = {"evaluate", result, "--self"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments, conditions);
  }

  void SetUp() override {
    fs::remove_all(output());
    fs::copy(reference(), output(), fs::copy_options::recursive);
  }

 private:
  static TempFolder* folder_;
};

TempFolder* SelfCheck::folder_ = nullptr;

TEST_F(SelfCheck, JudgesWithoutATruthAndBesideOne) {
  const Json alone = ReadJsonFile(output() / "evaluation.json");
  EXPECT_GT(alone.at("self_score").get<double>(), 0.5);
  EXPECT_LE(alone.at("self_score").get<double>(), 1.0);
  EXPECT_EQ(alone.at("self_panoramas").size(), 3u);
  EXPECT_TRUE(alone.at("area_iou_net").is_null());
  EXPECT_GT(alone.at("seconds").get<double>(), 0);

  ASSERT_EQ(RunProgram({"evaluate", output(), "--truth", home()}).exit_code, 0);
  const Json both = ReadJsonFile(output() / "evaluation.json");
  EXPECT_GT(both.at("area_iou_net").get<double>(), 0.8);
  EXPECT_EQ(both.at("self_score"), alone.at("self_score"));
  EXPECT_EQ(both.at("self_panoramas"), alone.at("self_panoramas"));

  // Checked again, it leaves the figures against the truth alone.
  ASSERT_EQ(Check(output()).exit_code, 0);
  EXPECT_EQ(ReadJsonFile(output() / "evaluation.json"), both);
}

TEST_F(SelfCheck, APlanWithoutAPanoramaHasNotHeardOfIt) {
  const std::string left_out = ReadJsonFile(Plan(reference(), 1)).at("provenance").at("without");
  const fs::path others = folder() / "others", result = folder() / "others_result";
  fs::copy(home(), others, fs::copy_options::recursive);
  fs::remove(others / "panos" / left_out);
  Json poses = ReadJsonFile(others / "transforms.json");
  Json frames = Json::array();
  for (const Json& frame : poses.at("frames")) {
    if (fs::path(frame.at("file_path").get<std::string>()).filename() != left_out)
      frames.push_back(frame);
  }
  poses["frames"] = frames;
  WriteJsonFile(others / "transforms.json", poses);
  RunHome(others, result);
  const Json plan = ReadJsonFile(result / "floorplan.json");
  const Json plan_without = ReadJsonFile(Plan(reference(), 1));
  for (const char* key : {"storeys", "cameras", "home_from_world"}) {
    EXPECT_EQ(plan_without.at(key), plan.at(key)) << key;
  }

  // Two panoramas are too few to leave one out.
  ASSERT_EQ(Check(result).exit_code, 0);
  EXPECT_TRUE(ReadJsonFile(result / "evaluation.json").at("self_score").is_null());
}

TEST_F(SelfCheck, GoesOnWhereItWasStopped) {
  fs::remove_all(output() / "leave_one_out");
  const ProgramResult stopped =
      Check(output(), {},
            {.signal_when = [&] { return fs::exists(Plan(output(), 0)); }, .signal = SIGINT});
  EXPECT_EQ(stopped.exit_code, 128 + SIGINT);
  EXPECT_FALSE(fs::exists(Plan(output(), 2)));
  const auto written = fs::last_write_time(Plan(output(), 0));
  ASSERT_EQ(Check(output(), {"--threads", "2"}).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(Plan(output(), 0)), written);
  for (int view = 0; view < 3; ++view) {
    EXPECT_TRUE(ReadFile(Plan(output(), view)) == ReadFile(Plan(reference(), view))) << view;
  }
}

TEST_F(SelfCheck, JoinsTheFiguresOfABatch) {
  const fs::path manifest = folder() / "homes.json", batch = folder() / "batch";
  WriteJsonFile(manifest,
                {{"homes", Json::array({{{"name", "room"}, {"pictures", home().native()}}})}});
  const ProgramResult result = RunProgram(
      {"evaluate", batch, "--batch", manifest, "--self", "--structure.num_columns", "128"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("`self_score`"));
  const Json figures = ReadJsonFile(batch / "batch.json").at("homes").at(0).at("figures");
  EXPECT_EQ(figures.at("self_score"),
            ReadJsonFile(reference() / "evaluation.json").at("self_score"));
}

TEST_F(SelfCheck, FallsWithTheResultThatItJudges) {
  const auto score = [] {
    EXPECT_EQ(RunProgram({"evaluate", output(), "--truth", home()}).exit_code, 0);
    return ReadJsonFile(output() / "evaluation.json").at("self_score");
  };
  // Drawings are no part of the plan.
  ASSERT_EQ(RunProgram({"export", output()}).exit_code, 0);
  EXPECT_EQ(score(), ReadJsonFile(reference() / "evaluation.json").at("self_score"));
  ASSERT_EQ(RunProgram({"floorplan", output(), "--floorplan.turn_cost_m", "0.3"}).exit_code, 0);
  EXPECT_TRUE(score().is_null());
}

TEST_F(SelfCheck, RefusesWhatItCannotCheck) {
  ExpectRefusal(RunProgram({"evaluate", output(), "--self", "--max-memory", "20"}), "--max-memory");
  ASSERT_EQ(RunProgram({"evidence", output()}).exit_code, 0);
  ExpectRefusal(Check(output()), "holds no plan");
}

}  // namespace
}  // namespace enfilade
