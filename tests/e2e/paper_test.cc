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

  static void MakePlan(const std::string& mode = "paper") {
    const ProgramResult result = RunProgram({"floorplan", Output(), "--floorplan.mode", mode});
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
  for (const std::string mode : {"full", "paper"}) {
    SCOPED_TRACE(mode);
    MakePlan(mode);
    const nlohmann::json curve = Room().at("curve");
    ASSERT_GE(curve.size(), mode == "paper" ? 2u : 1u);  // the room is a rectangle
    EXPECT_EQ(curve.at(0).at("vertices"), 4);
    const std::string chosen = std::to_string(Room().at("polygon").size());
    const std::string drawing = ReadFile(output / "plan.svg");
    for (const size_t k : {size_t{0}, curve.size() - 1}) {
      const std::string number = std::to_string(curve.at(k).at("vertices").get<int>());
      SCOPED_TRACE(number);
      ProgramResult result = RunProgram({"floorplan", output, "--vertices", number});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      EXPECT_THAT(result.err, HasSubstr(number + " corners cost"));
      EXPECT_EQ(std::to_string(Room().at("polygon").size()), number);
      EXPECT_EQ(Room().at("curve"), curve);
      EXPECT_FALSE(fs::exists(output / "model.glb"));
      EXPECT_EQ(ReadFile(output / "plan.svg") == drawing, number == chosen) << "drawn anew";
      const std::string dialled = ReadFile(output / "floorplan.json");
      ASSERT_EQ(RunProgram({"floorplan", output, "--floorplan.mode", mode, "--vertices", number})
                    .exit_code,
                0);
      EXPECT_TRUE(ReadFile(output / "floorplan.json") == dialled) << "solved again it is another";
      ASSERT_EQ(RunProgram({"model", output}).exit_code, 0);
      ASSERT_EQ(RunProgram({"export", output}).exit_code, 0);
    }
    const ProgramResult result = RunProgram({"floorplan", output, "--vertices", "999"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("the nearest has"));
  }
}

TEST_F(Paper, TheDialBlamesAPlanThatItCannotTurn) {
  const fs::path plan = Output() / "floorplan.json";
  const auto refusal = [&](const std::string& number) {
    const ProgramResult result = RunProgram({"floorplan", Output(), "--vertices", number});
    EXPECT_NE(result.exit_code, 0);
    return result.err;
  };
  EXPECT_THAT(refusal("3"), HasSubstr("--vertices"));
  EXPECT_THAT(refusal("-8"), HasSubstr("--vertices"));
  EXPECT_THAT(refusal("99999999999999999999"), HasSubstr("--vertices"));
  EXPECT_THAT(refusal("1000000"), HasSubstr("nearest"));
  const std::string whole = ReadFile(plan);
  nlohmann::json json = nlohmann::json::parse(whole);
  json["storeys"][0]["rooms"][0].erase("curve");
  WriteJsonFile(plan, json);
  EXPECT_THAT(refusal("4"), HasSubstr("no curves"));
  WriteFileAtomic(plan, whole.substr(0, whole.size() / 2));
  EXPECT_THAT(refusal("4"), HasSubstr("no valid JSON"));
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
