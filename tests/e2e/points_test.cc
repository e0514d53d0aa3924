// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// Dense clouds that are given to a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "tests/e2e/program.h"
#include "tests/e2e/small_room.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Points : public testing::Test {
 protected:
  // A run up to the evidence is enough: later stages see no points.
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    WriteSmallRoom(*folder_ / "home", /*has_points=*/true);
    ASSERT_EQ(RunProgram({"sfm", *folder_ / "home", "-o", *folder_ / "sfm"}).exit_code, 0);
  }
  static void TearDownTestSuite() { delete folder_; }

  void SetUp() override {
    fs::remove_all(out());
    fs::copy(*folder_ / "sfm", out(), fs::copy_options::recursive);
  }

  static fs::path home() { return *folder_ / "home"; }
  static fs::path out() { return *folder_ / "out"; }
  static fs::path fused() { return home() / "dense" / "fused.ply"; }
  static fs::path patches() { return home() / "pmvs" / "models" / "option-0000.patch"; }

  std::string Evidence(const std::vector<std::string>& cloud) {
    std::vector<std::string> arguments = {"points", out().native()};
    arguments.insert(arguments.end(), cloud.begin(), cloud.end());
    const ProgramResult points = RunProgram(arguments);
    EXPECT_EQ(points.exit_code, 0) << points.err;
    for (const char* stage : {"structure", "evidence"}) {
      const ProgramResult result = RunProgram({stage, out()});
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
    return ReadFile(out() / "evidence" / "storey_0.bin");
  }

 private:
  static TempFolder* folder_;
};
TempFolder* Points::folder_ = nullptr;

TEST_F(Points, BothFormsGiveTheSameEvidence) {
  const std::string without = Evidence({});
  EXPECT_FALSE(fs::exists(out() / "cloud.bin"));
  const std::string by_colmap = Evidence({"--points", fused()});
  const std::string cloud = ReadFile(out() / "cloud.bin");
  EXPECT_NE(by_colmap, without);
  EXPECT_EQ(Evidence({"--points", patches()}), by_colmap);
  EXPECT_EQ(ReadFile(out() / "cloud.bin").size(), cloud.size());
  // And away again.
  EXPECT_EQ(Evidence({}), without);
  EXPECT_FALSE(fs::exists(out() / "cloud.bin"));
}

TEST_F(Points, RunGoesOnWhereTheCloudIsTheSame) {
  const std::vector<std::string> run = {"run", home(), "-o", out(), "--points", patches()};
  const ProgramResult first = RunProgram(run);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const ProgramResult second = RunProgram(run);
  EXPECT_THAT(second.err, HasSubstr("points: up to date"));
  EXPECT_THAT(second.err, HasSubstr("export: up to date"));
  // Where it lies is nobody's business but the manifest's.
  const std::string plan = ReadFile(out() / "floorplan.json");
  EXPECT_THAT(plan, Not(HasSubstr("option-0000")));
  // A cloud that has changed is read again.
  const std::string whole = ReadFile(patches());
  std::ofstream(patches(), std::ios::app) << "\n";
  EXPECT_THAT(RunProgram(run).err, Not(HasSubstr("points: up to date")));
  std::ofstream(patches(), std::ios::binary) << whole;
}

TEST_F(Points, SaysWhoSeesThePointsOfAnyPly) {
  const fs::path alone = out() / "alone.ply";
  fs::copy_file(fused(), alone);
  const ProgramResult result = RunProgram({"points", out(), "--points", alone});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("rays cast against the cloud itself"));
}

TEST_F(Points, RefusesBrokenCloudsBeforeAnythingElse) {
  const fs::path broken = out().parent_path() / "broken.ply";
  ExpectRefusal(RunProgram({"points", out(), "--points", broken}), "broken.ply");
  const fs::path fresh = out().parent_path() / "fresh";
  ExpectRefusal(RunProgram({"run", home(), "-o", fresh, "--points", broken}), "broken.ply");
  EXPECT_FALSE(fs::exists(fresh));
  std::ofstream(broken) << "ply\nformat ascii 1.0\nelement vertex 5\nend_header\n";
  ExpectRefusal(RunProgram({"points", out(), "--points", broken}), "PLY header");
  ExpectRefusal(RunProgram({"points", out(), "--points", fused(), "--points-up", "sideways"}),
                "sideways");
  ExpectRefusal(RunProgram({"points", out(), "--points", patches(), "--points-scale", "0.001"}),
                "is not in the world of the poses");
}

}  // namespace
}  // namespace enfilade
