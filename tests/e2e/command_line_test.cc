// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "enfilade/base/file.h"
#include "tests/e2e/program.h"
#include "tests/support/source_folder.h"

namespace enfilade {
namespace {

using testing::HasSubstr;

TEST(CommandLine, AlonePrintsTheCommandsInFlowOrder) {
  const ProgramResult result = RunProgram({});
  EXPECT_EQ(result.exit_code, 0);
  size_t last = 0;
  for (const std::string command :
       {"\n  run", "\n  sfm", "\n  structure", "\n  evidence", "\n  floorplan", "\n  model",
        "\n  export", "\n  evaluate", "\n  compare", "\n  why", "\n  doctor", "\n  config",
        "\n  version"}) {
    const size_t at = result.out.find(command);
    ASSERT_NE(at, std::string::npos) << command << result.out;
    EXPECT_GT(at, last) << command;
    last = at;
  }
}

TEST(CommandLine, SuggestsTheNearestCommandAndOption) {
  ExpectRefusal(RunProgram({"confgi"}), "did you mean 'config'?");
  ExpectRefusal(RunProgram({"config", "--jsno"}), "did you mean '--json'?");
  ExpectRefusal(RunProgram({"config", "--config"}), "--config");
  ExpectRefusal(RunProgram({"--nothing-like-it"}), "there is no option '--nothing-like-it'");
}

TEST(CommandLine, RefusesBrokenConfigFiles) {
  ExpectRefusal(RunProgram({"config", "--config", "/nowhere.json"}), "/nowhere.json");
  ExpectRefusal(RunProgram({"config", "--config", "/proc/self/exe"}), "/proc/self/exe");
  ExpectRefusal(RunProgram({"config", "--config", "/dev/null"}), "/dev/null");
}

TEST(CommandLine, EvaluateRefusesOptionsThatWouldChangeNothing) {
  const auto evaluate = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"evaluate", "/nowhere"});
    return RunProgram(more);
  };
  ExpectRefusal(evaluate({"--batch", "homes.json", "--ablation"}), "--ablation requires --truth");
  ExpectRefusal(evaluate({"--truth", "t", "--structure.use_floor", "false"}),
                "--structure.use_floor: has no effect");
  ExpectRefusal(evaluate({"--truth", "t", "--config", "c.json"}), "--config: has no effect");
  ExpectRefusal(evaluate({"--truth", "t", "--ablation", "--floorplan.turn_cost_m", "1"}),
                "--floorplan.turn_cost_m: has no effect with --ablation");
  // These are taken, and the folder is what is wrong.
  ExpectRefusal(evaluate({"--truth", "t", "--ablation", "--structure.use_floor", "false"}),
                "/nowhere");
  ExpectRefusal(evaluate({"--truth", "t"}), "/nowhere");
}

TEST(CommandLine, VersionNamesTheProgram) {
  const ProgramResult result = RunProgram({"version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, testing::StartsWith("enfilade 0."));
}

TEST(CommandLine, ConfigPrintsJsonThatConfigReads) {
  const ProgramResult result = RunProgram({"config", "--json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(nlohmann::json::parse(result.out).is_object());
}

TEST(CommandLine, ReferencePageIsCurrent) {
  const ProgramResult result = RunProgram({"config", "--markdown"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, ReadFile(SourceFolder() / "docs/command_reference.md"))
      << "make it anew: enfilade config --markdown > docs/command_reference.md";
}

}  // namespace
}  // namespace enfilade
