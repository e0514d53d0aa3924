// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The paper's floorplan on the command line, its dial and its page of pictures.
#include <gmock/gmock.h>

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
using testing::HasSubstr;

class Paper : public testing::Test {
 protected:
  // Makes the home and its result once for all tests.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    ASSERT_EQ(RunProgram({"synth", "-o", Home(), "--preset", "room", "--width", "512"}).exit_code,
              0);
    ASSERT_EQ(RunProgram({"run", Home(), "-o", Output()}).exit_code, 0);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  // The usual plan stands.
  void SetUp() override { ASSERT_EQ(RunProgram({"floorplan", Output()}).exit_code, 0); }

  static fs::path Home() { return folder_->path() / "home"; }
  static fs::path Output() { return folder_->path() / "out"; }

  static void MakePlan() {
    const ProgramResult result = RunProgram({"floorplan", Output(), "--floorplan.mode", "paper"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    ASSERT_EQ(RunProgram({"model", Output()}).exit_code, 0);
    ASSERT_EQ(RunProgram({"export", Output()}).exit_code, 0);
  }
  static nlohmann::json Room() {
    return ReadJsonFile(Output() / "floorplan.json").at("storeys").at(0).at("rooms").at(0);
  }

 private:
  static TempFolder* folder_;
};

TempFolder* Paper::folder_ = nullptr;

TEST_F(Paper, TheDialRedrawsThePlanWithoutSolving) {
  const fs::path output = Output();
  ProgramResult result = RunProgram({"floorplan", output, "--vertices", "4"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no curves"));

  MakePlan();
  const nlohmann::json curve = Room().at("curve");
  ASSERT_GE(curve.size(), 2u);
  EXPECT_EQ(curve.at(0).at("vertices"), 4);
  const std::string chosen = std::to_string(Room().at("polygon").size());
  const std::string drawing = ReadFile(output / "plan.svg");
  for (const size_t k : {size_t{0}, curve.size() - 1}) {
    const std::string number = std::to_string(curve.at(k).at("vertices").get<int>());
    SCOPED_TRACE(number);
    result = RunProgram({"floorplan", output, "--vertices", number});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(std::to_string(Room().at("polygon").size()), number);
    EXPECT_EQ(Room().at("curve"), curve);
    EXPECT_FALSE(fs::exists(output / "model.glb"));
    EXPECT_EQ(ReadFile(output / "plan.svg") == drawing, number == chosen) << "drawn anew";
    const std::string dialled = ReadFile(output / "floorplan.json");
    ASSERT_EQ(RunProgram({"floorplan", output, "--floorplan.mode", "paper", "--vertices", number})
                  .exit_code,
              0);
    EXPECT_TRUE(ReadFile(output / "floorplan.json") == dialled) << "solved again it is another";
    ASSERT_EQ(RunProgram({"model", output}).exit_code, 0);
    ASSERT_EQ(RunProgram({"export", output}).exit_code, 0);
  }
  result = RunProgram({"floorplan", output, "--vertices", "999"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("the nearest has"));
}

TEST_F(Paper, ThePageExplainsThePlanThatStands) {
  const fs::path output = Output();
  ASSERT_EQ(RunProgram({"floorplan", output, "--explain"}).exit_code, 0);
  const std::string full = ReadFile(output / "explain.svg");
  MakePlan();
  EXPECT_FALSE(fs::exists(output / "explain.svg")) << "it explained another plan";
  const std::string plan = ReadFile(output / "floorplan.json");
  ASSERT_EQ(RunProgram({"floorplan", output, "--explain"}).exit_code, 0);
  EXPECT_GT(ReadFile(output / "explain.svg").size(), full.size());
  EXPECT_TRUE(fs::exists(output / "explain.png"));
  EXPECT_TRUE(ReadFile(output / "floorplan.json") == plan);
  EXPECT_TRUE(fs::exists(output / "model.glb"));
  const ProgramResult result =
      RunProgram({"floorplan", output, "--explain", "--explain-truth", Output() / "nothing"});
  EXPECT_EQ(result.exit_code, 1);
  ASSERT_EQ(RunProgram({"floorplan", output, "--explain", "--explain-truth", Home()}).exit_code, 0);
}

}  // namespace
}  // namespace enfilade
