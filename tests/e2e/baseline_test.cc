// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// `baseline`: the rival's plans beside that of a run.
#include <gmock/gmock.h>

#include <filesystem>
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
using testing::HasSubstr;

const char* const kLambdas[] = {"100", "400", "1600"};

class Baseline : public testing::Test {
 protected:
  // A room with three panoramas and its result, made once for all tests.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    WriteSmallRoom(home());
    const ProgramResult run =
        RunProgram({"run", home(), "-o", reference(), "--structure.num_columns", "128"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path home() { return folder_->path() / "home"; }
  static fs::path reference() { return folder_->path() / "reference"; }
  static fs::path output() { return folder_->path() / "out"; }
  static fs::path Rival(const std::string& lambda) {
    return output() / "baselines" / ("cut_lambda" + lambda);
  }
  static ProgramResult Draw(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"baseline", output()});
    return RunProgram(more);
  }

  void SetUp() override {
    fs::remove_all(output());
    fs::copy(reference(), output(), fs::copy_options::recursive);
  }

 private:
  static TempFolder* folder_;
};

TempFolder* Baseline::folder_ = nullptr;

TEST_F(Baseline, DrawsAndJudgesThreePlans) {
  const std::string own_plan = ReadFile(output() / "floorplan.json");
  const ProgramResult result = Draw({"--truth", home()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("area_error_gross"));
  EXPECT_THAT(result.out, HasSubstr("\nfloorplan "));
  EXPECT_THAT(result.out, HasSubstr("\npaper "));
  const nlohmann::json paper = ReadJsonFile(output() / "baselines/paper/evaluation.json");
  EXPECT_GT(paper.at("area_iou_gross").get<double>(), 0.8);
  for (const char* lambda : kLambdas) {
    EXPECT_THAT(result.out, HasSubstr("\ncut_lambda" + std::string(lambda) + " "));
    const nlohmann::json plan = ReadJsonFile(Rival(lambda) / "floorplan.json");
    EXPECT_EQ(plan.at("storeys").at(0).at("rooms").size(), 1u);
    EXPECT_EQ(plan.at("provenance").at("options").at("baseline").at("lambda"), std::stod(lambda));
    const nlohmann::json figures = ReadJsonFile(Rival(lambda) / "evaluation.json");
    EXPECT_GT(figures.at("area_iou_gross").get<double>(), 0.8);
    EXPECT_TRUE(fs::exists(Rival(lambda) / "plan.svg"));
    EXPECT_TRUE(fs::exists(Rival(lambda) / "overlay.png"));
  }
  EXPECT_THAT(result.out, HasSubstr("orientation maps 0."));
  EXPECT_TRUE(fs::exists(output() / "baselines/orientation/labels_0000_final.png"));
  EXPECT_TRUE(fs::exists(output() / "baselines/orientation/labels_0000.jpg"));
  EXPECT_EQ(ReadFile(output() / "floorplan.json"), own_plan);
}

TEST_F(Baseline, SameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(Draw({"--threads", "1"}).exit_code, 0);
  std::vector<std::string> first;
  for (const char* lambda : kLambdas) first.push_back(ReadFile(Rival(lambda) / "floorplan.json"));
  ASSERT_EQ(Draw({"--threads", "3"}).exit_code, 0);
  for (size_t i = 0; i < first.size(); ++i)
    EXPECT_TRUE(ReadFile(Rival(kLambdas[i]) / "floorplan.json") == first[i]) << kLambdas[i];
}

TEST_F(Baseline, TakesLogOddsAndOtherLambdas) {
  ASSERT_EQ(Draw({"--baseline.evidence", "log_odds", "--baseline.lambda", "50"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(output() / "baselines/cut_log_odds_lambda50/floorplan.json"));
  EXPECT_TRUE(fs::exists(output() / "baselines/cut_log_odds_lambda800/floorplan.json"));
  EXPECT_FALSE(fs::exists(Rival("100")));
}

TEST_F(Baseline, FallsWithTheResultBesideWhichItStands) {
  ASSERT_EQ(Draw().exit_code, 0);
  ASSERT_EQ(RunProgram({"evidence", output(), "--evidence.grid.near_m", "2"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(output() / "baselines"));
}

TEST_F(Baseline, SaysSoWhenNothingIsInside) {
  ASSERT_EQ(Draw().exit_code, 0);
  const ProgramResult result = Draw({"--baseline.good_free_rays", "100000"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("cut_lambda100 has no rooms"));
  EXPECT_FALSE(fs::exists(Rival("100")));
}

TEST_F(Baseline, RefusesAResultWithoutEvidence) {
  ASSERT_EQ(RunProgram({"structure", output(), "--structure.num_columns", "128"}).exit_code, 0);
  ExpectRefusal(Draw(), "stage 'evidence' has no result there");
  ExpectRefusal(RunProgram({"baseline", home()}), "home");
  ExpectRefusal(RunProgram({"baseline", output(), "--baseline.lamda", "1"}), "--baseline.lambda");
}

}  // namespace
}  // namespace enfilade
