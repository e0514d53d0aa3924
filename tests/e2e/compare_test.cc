// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// `compare`: all methods beside that of a run.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
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
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// Small pictures of the models, for speed.
const char* const kSmallViews = "--compare.view_width";
const char* const kViewWidth = "128";

// Those that find something in any room.
const char* const kMethods[] = {"full",           "paper",      "cut_lambda100", "cut_lambda400",
                                "cut_lambda1600", "volume_cut", "poisson"};

class Compare : public testing::Test {
 protected:
  // A room with three panoramas, its result and the comparison of all methods, made once.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    fs::permissions(folder_->path(), fs::perms::all);
    WriteSmallRoom(home(), false, /*has_pixel_truth=*/true);
    const ProgramResult run =
        RunProgram({"run", home(), "-o", bare(), "--structure.num_columns", "128"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    fs::copy(bare(), compared(), fs::copy_options::recursive);
    first_ = RunProgram({"compare", compared(), "--truth", home(), kSmallViews, kViewWidth});
    ASSERT_EQ(first_.exit_code, 0) << first_.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path home() { return folder_->path() / "home"; }
  static fs::path bare() { return folder_->path() / "bare"; }
  static fs::path compared() { return folder_->path() / "compared"; }
  static fs::path output() { return folder_->path() / "out"; }
  static fs::path Of(const std::string& file) { return output() / "compare" / file; }
  static json Comparison() { return ReadJsonFile(Of("comparison.json")); }
  static json Row(const std::string& name) {
    const json comparison = Comparison();
    for (const json& method : comparison.at("methods")) {
      if (method.at("name") == name) return method;
    }
    return {};
  }
  static ProgramResult Again(std::vector<std::string> more = {},
                             const ProgramConditions& conditions = {}) {
    more.insert(more.begin(), {"compare", output(), kSmallViews, kViewWidth});
    return RunProgram(more, conditions);
  }
  // Each test starts with the comparison, or without.
  static void StartFrom(const fs::path& result) {
    fs::remove_all(output());
    fs::copy(result, output(), fs::copy_options::recursive);
  }

  void SetUp() override { StartFrom(compared()); }

  static ProgramResult first_;

 private:
  static TempFolder* folder_;
};

TempFolder* Compare::folder_ = nullptr;
ProgramResult Compare::first_;

// Figures that time and memory tell, which no two runs have in common.
json WithoutCosts(json comparison) {
  for (json& method : comparison.at("methods")) {
    method.at("figures").erase("seconds");
    method.at("figures").erase("peak_memory_mb");
  }
  return comparison;
}

// From the plans on, the page says nothing of time and memory.
std::string PicturesOf(const fs::path& page) {
  const std::string html = ReadFile(page);
  return html.substr(html.find("<h2>"));
}

TEST_F(Compare, JudgesEveryMethod) {
  EXPECT_EQ(Comparison().at("methods").size(), 8u);
  EXPECT_THAT(first_.out, HasSubstr("\npolygonal surface "));
  for (const char* name : kMethods) {
    SCOPED_TRACE(name);
    const json row = Row(name);
    ASSERT_EQ(row.at("outcome"), "found") << row.at("reason");
    const json& figures = row.at("figures");
    EXPECT_GT(figures.at("area_iou_gross").get<double>(), 0.8);
    EXPECT_LT(figures.at("depth_median_m").get<double>(), 0.3);
    EXPECT_LT(figures.at("normal_median_deg").get<double>(), 20);
    EXPECT_EQ(figures.at("rooms"), 1);
    EXPECT_GE(figures.at("faces"), 6);
    EXPECT_GT(figures.at("seconds").get<double>(), 0);
    EXPECT_GT(figures.at("peak_memory_mb").get<double>(), 10);
    for (const char* file : {"floorplan.json", "plan.svg", "model.obj", "model.mtl", "record.json",
                             "evaluation.json", "overlay.png"})
      EXPECT_TRUE(fs::exists(Of(name) / file)) << file;
    EXPECT_FALSE(fs::exists(Of(name) / "log.txt"));
    EXPECT_THAT(first_.out, HasSubstr("\n" + row.at("title").get<std::string>() + " "));
  }
  const json plan = ReadJsonFile(Of("cut_lambda400/floorplan.json"));
  EXPECT_EQ(plan.at("provenance").at("options").at("cut").at("lambda"), 400);
  EXPECT_EQ(ReadFile(output() / "floorplan.json"), ReadFile(bare() / "floorplan.json"));
}

TEST_F(Compare, TheFullSolverDrawsThePlanOfTheRun) {
  json own = ReadJsonFile(output() / "floorplan.json");
  json again = ReadJsonFile(Of("full/floorplan.json"));
  own.erase("provenance");
  again.erase("provenance");
  EXPECT_EQ(again, own);
}

TEST_F(Compare, WritesAPageWithLabelMaps) {
  const std::string html = ReadFile(Of("comparison.html"));
  EXPECT_THAT(html, HasSubstr("out"));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, HasSubstr("orientation map"));
  EXPECT_LT(html.size(), 3'000'000u);
  const json labels = Comparison().at("labels");
  EXPECT_GT(labels.at("superpixels").get<double>(), 0.8);
  EXPECT_GT(labels.at("orientation_completed").get<double>(), 0.3);
  EXPECT_TRUE(fs::exists(Of("orientation/labels_0000_final.png")));
  EXPECT_TRUE(fs::exists(Of("labels/labels_0000_final.png")));
  EXPECT_FALSE(fs::exists(output() / "structure/labels_0000_final.png"));
}

TEST_F(Compare, DoesNothingTwice) {
  std::vector<fs::file_time_type> times;
  for (const char* name : kMethods) times.push_back(fs::last_write_time(Of(name) / "record.json"));
  ASSERT_EQ(Again({"--truth", home()}).exit_code, 0);
  for (size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(fs::last_write_time(Of(kMethods[i]) / "record.json"), times[i]) << kMethods[i];
  EXPECT_TRUE(PicturesOf(Of("comparison.html")) ==
              PicturesOf(compared() / "compare/comparison.html"));
  EXPECT_TRUE(ReadFile(Of("comparison.json")) == ReadFile(compared() / "compare/comparison.json"));
}

TEST_F(Compare, NamesWhoTakesTooLongAndGoesOn) {
  // The others stand; only the cut in space is run again.
  const std::vector<std::string> coarse = {"--compare.volume_cut.voxel_m", "0.1"};
  std::vector<std::string> hasty = coarse;
  hasty.insert(hasty.end(), {"--compare.max_seconds", "0.01"});
  std::vector<std::string> judged = hasty;
  judged.insert(judged.end(), {"--truth", home()});
  const ProgramResult result = Again(judged);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Row("volume_cut").at("outcome"), "out_of_time");
  EXPECT_THAT(Row("volume_cut").at("reason").get<std::string>(), HasSubstr("0.01 s"));
  EXPECT_TRUE(Row("volume_cut").at("figures").at("area_error_gross").is_null());
  EXPECT_EQ(Row("poisson").at("outcome"), "found");
  EXPECT_THAT(result.out, HasSubstr("3D cut gave up: not done after 0.01 s"));
  EXPECT_THAT(ReadFile(Of("comparison.html")), HasSubstr("not done after 0.01 s"));
  EXPECT_FALSE(fs::exists(Of("volume_cut/model.obj")));
  // With as much time it is not tried again, with more it is.
  const fs::file_time_type time = fs::last_write_time(Of("volume_cut/record.json"));
  ASSERT_EQ(Again(hasty).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(Of("volume_cut/record.json")), time);
  ASSERT_EQ(Again(coarse).exit_code, 0);
  EXPECT_EQ(Row("volume_cut").at("outcome"), "found");
}

TEST_F(Compare, NamesWhoTakesTooMuchMemoryAndGoesOn) {
  const ProgramResult result =
      Again({"--compare.poisson.spacing_m", "0.11", "--compare.max_memory_mb", "64"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Row("poisson").at("outcome"), "out_of_memory");
  EXPECT_THAT(result.out, HasSubstr("Poisson surface gave up: it needs more than 64 MB"));
  EXPECT_EQ(Row("volume_cut").at("outcome"), "found");
}

TEST_F(Compare, NamesWhoFindsNothing) {
  const ProgramResult result = Again({"--compare.cut.good_free_rays", "100000"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Row("cut_lambda100").at("outcome"), "no_result");
  EXPECT_THAT(result.out, HasSubstr("2D cut, λ = 100 found nothing: "));
  EXPECT_THAT(result.err, HasSubstr("2D cut, λ = 100 has no result"));
  EXPECT_FALSE(fs::exists(Of("cut_lambda100/floorplan.json")));
}

TEST_F(Compare, SaysWithoutTruthThatNothingIsJudged) {
  const ProgramResult result = Again();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(ReadFile(Of("comparison.html")), HasSubstr("No truth was given"));
  EXPECT_EQ(Row("full").at("figures").count("area_iou_net"), 0u);
}

TEST_F(Compare, TakesLogOddsAndOtherLambdas) {
  ASSERT_EQ(Again({"--compare.cut_evidence", "log_odds", "--compare.cut.lambda", "50"}).exit_code,
            0);
  EXPECT_TRUE(fs::exists(Of("cut_log_odds_lambda50/floorplan.json")));
  EXPECT_TRUE(fs::exists(Of("cut_log_odds_lambda800/floorplan.json")));
}

TEST_F(Compare, GoesOnWithoutThePictures) {
  const fs::path moved = home() / "moved.jpg";
  fs::path picture;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(home())) {
    if (entry.path().extension() == ".jpg") picture = entry.path();
  }
  fs::rename(picture, moved);
  // Those who look at pictures and those who do not are run again.
  for (const char* name : {"full", "paper"}) fs::remove_all(Of(name));
  const ProgramResult result = Again({"--truth", home()});
  fs::rename(moved, picture);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Row("full").at("outcome"), "failed");
  EXPECT_THAT(Row("full").at("reason").get<std::string>(), HasSubstr(picture.filename().native()));
  EXPECT_EQ(Row("paper").at("outcome"), "found");
  EXPECT_THAT(ReadFile(Of("comparison.html")), HasSubstr("There are none: "));
}

TEST_F(Compare, FallsWithTheResultBesideWhichItStands) {
  ASSERT_EQ(RunProgram({"evidence", output(), "--evidence.grid.near_m", "2"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(output() / "compare"));
}

TEST_F(Compare, StopsOnASignalAndResumesToTheSameBytesForAnyNumberOfThreads) {
  StartFrom(bare());
  const std::vector<std::string> alone = {"--truth", home(), "--threads", "1"};
  const ProgramResult stopped =
      Again(alone, {.signal_when = [] { return fs::exists(Of("paper")); }, .signal = SIGTERM});
  EXPECT_EQ(stopped.exit_code, 128 + SIGTERM) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("run the same command again to resume"));
  EXPECT_FALSE(fs::exists(Of("comparison.html")));
  const fs::file_time_type time = fs::last_write_time(Of("full/record.json"));
  ASSERT_EQ(Again(alone).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(Of("full/record.json")), time);
  const fs::path reference = compared() / "compare";
  const json again = WithoutCosts(Comparison());
  const json before = WithoutCosts(ReadJsonFile(reference / "comparison.json"));
  for (size_t i = 0; i < std::size(kMethods); ++i) {
    const std::string name = kMethods[i];
    // CGAL's mesher goes by addresses where it has a choice, which differ from run to run.
    if (name == "poisson") continue;
    EXPECT_EQ(again.at("methods").at(i), before.at("methods").at(i));
    for (const char* file : {"floorplan.json", "model.obj"})
      EXPECT_TRUE(ReadFile(Of(name) / file) == ReadFile(reference / name / file))
          << name << " " << file;
  }
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  ExpectRefusal(RunProgram({"compare", home()}), "home");
  ExpectRefusal(Again({"--compare.max_second", "1"}), "--compare.max_seconds");
  ExpectRefusal(Again({"--compare.max_seconds", "0"}), "compare.max_seconds");
  ExpectRefusal(Again({"--truth", output() / "structure"}), "structure");
  // The truth of another home.
  const fs::path other = output() / "other";
  fs::create_directories(other);
  json truth = ReadJsonFile(home() / "truth/floorplan.json");
  for (json& camera : truth.at("cameras")) {
    camera["picture"] = "other_" + camera.at("picture").get<std::string>();
    camera.erase("sha256");
  }
  WriteJsonFile(other / "floorplan.json", truth);
  ExpectRefusal(Again({"--truth", other}), "give the truth of the same home");
  fs::remove_all(output());
  ASSERT_EQ(RunProgram({"sfm", home(), "-o", output()}).exit_code, 0);
  ExpectRefusal(Again(), "holds no wall profiles");
}

TEST_F(Compare, RefusesAFolderThatIsReadOnly) {
  for (const fs::path& folder : {output(), Of("")}) {
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                fs::perms::others_exec);
  }
  ProgramConditions as_nobody;
  as_nobody.is_as_nobody = geteuid() == 0;
  ExpectRefusal(Again({}, as_nobody), output());
  fs::permissions(output(), fs::perms::all);
  fs::permissions(Of(""), fs::perms::all);
}

}  // namespace
}  // namespace enfilade
