// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// `evaluate --batch`: many homes in one table.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "tests/e2e/program.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Batch : public testing::Test {
 protected:
  void WriteManifest(const Json& homes) const { WriteJsonFile(manifest(), {{"homes", homes}}); }
  [[nodiscard]] fs::path manifest() const { return folder_ / "homes.json"; }
  [[nodiscard]] fs::path output() const { return folder_ / "out"; }
  [[nodiscard]] ProgramResult Run() const {
    return RunProgram({"evaluate", output(), "--batch", manifest()});
  }

 private:
  TempFolder folder_;
};

Json QuickRoom(const std::string& name, int seed) {
  return {
      {"name", name},
      {"synth",
       {{"home", {{"seed", seed}, {"preset", "room"}, {"furniture", 0.0}}},
        {"pictures",
         {{"width", 256},
          {"has_pixel_truth", true},
          {"render", {{"samples_per_pixel", 1}, {"gather_rays", 16}, {"light_cell_m", 0.2}}}}}}}};
}

TEST_F(Batch, MakesJudgesAndGoesOnPastAFailure) {
  WriteManifest(Json::array({{{"name", "lost"}, {"pictures", "nowhere"}}, QuickRoom("room", 1)}));
  const ProgramResult result = Run();
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.out, testing::HasSubstr("2 homes, 1 of them failed."));
  const Json table = ReadJsonFile(output() / "batch.json");
  EXPECT_EQ(table.at("failed"), 1);
  EXPECT_THAT(table.at("homes").at(0).at("error").get<std::string>(),
              testing::HasSubstr("nowhere"));
  EXPECT_GT(table.at("summary").at("area_iou_net").at("mean").get<double>(), 0.5);
  EXPECT_GT(table.at("summary").at("label_accuracy").at("mean").get<double>(), 0.8);
  EXPECT_GT(table.at("summary").at("model_hit_share").at("mean").get<double>(), 0.9);
  EXPECT_LT(table.at("summary").at("pose_median_m").at("mean").get<double>(), 1e-5);
  const fs::path results = output() / "results" / "room";
  EXPECT_TRUE(fs::exists(results / "evaluation.json"));
  EXPECT_TRUE(fs::exists(results / "error_maps" / "pano_000.png"));
  EXPECT_EQ(ReadFile(output() / "batch.md"), result.out);

  // A second time nothing is made again, and the figures are the same.
  const Json area = table.at("summary").at("area_iou_net");
  const fs::path picture = output() / "homes" / "room" / "panos" / "pano_000.jpg";
  const auto made = fs::last_write_time(picture);
  EXPECT_EQ(Run().exit_code, 3);
  EXPECT_EQ(fs::last_write_time(picture), made);
  EXPECT_EQ(ReadJsonFile(output() / "batch.json").at("summary").at("area_iou_net"), area);

  // Another seed under the same name is another home.
  WriteManifest(Json::array({QuickRoom("room", 2)}));
  EXPECT_EQ(Run().exit_code, 0);
  EXPECT_NE(ReadJsonFile(output() / "batch.json").at("summary").at("area_iou_net"), area);
}

TEST_F(Batch, GoesOnWhereItWasKilled) {
  WriteManifest(Json::array({QuickRoom("room", 1)}));
  ProgramConditions conditions;
  conditions.signal = SIGKILL;
  conditions.signal_when = [&] {
    return fs::exists(output() / "homes" / "room" / "panos" / "pano_000.jpg");
  };
  (void)RunProgram({"evaluate", output(), "--batch", manifest()}, conditions);
  const ProgramResult result = Run();
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Batch, RefusesBrokenManifests) {
  ExpectRefusal(Run(), manifest());
  for (const char* text : {"", "{\"homes\": [", "[]", "{\"homes\": 3}", "{\"homes\": []}",
                           "{\"homes\": [3]}", "{\"homes\": [{\"name\": \"a\"}]}",
                           "{\"homes\": [{\"name\": \"../a\", \"pictures\": \"x\"}]}",
                           "{\"homes\": [{\"name\": \"a\", \"pictures\": 7}]}",
                           "{\"homes\": [{\"name\": \"a\", \"picture\": \"x\"}]}",
                           "{\"homes\": [{\"name\": \"a\", \"synth\": {\"home\": {\"sed\": 1}}}]}",
                           "{\"homes\": [{\"name\": \"a\", \"pictures\": \"x\"}, "
                           "{\"name\": \"a\", \"pictures\": \"y\"}]}"}) {
    WriteFileAtomic(manifest(), text);
    ExpectRefusal(Run(), manifest());
    EXPECT_FALSE(fs::exists(output())) << text;
  }
}

}  // namespace
}  // namespace enfilade
