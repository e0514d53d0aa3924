// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/stage.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <optional>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

struct LetterOptions {
  int repeats = 1;
  void Visit(OptionVisitor& v) { v("repeats", repeats, "How often the letter is written."); }
};

// Three stages that append a letter to what the stage before wrote: a (file), b (folder), c (file).
class Letters {
 public:
  explicit Letters(fs::path root) : workspace(std::move(root)) {}

  StageResult Run(Rerun rerun = Rerun::kWhenNeeded) {
    ran.clear();
    const WorkspaceLock lock(workspace, WorkspaceUse::kCreate);
    Manifest manifest;
    if (fs::exists(workspace.manifest_file())) manifest = ReadManifest(workspace.manifest_file());
    manifest.program = program;
    return RunStages(workspace, Stages(), "", {"verdict"}, rerun, manifest, context);
  }

  // What is in the result folder, but for the manifest's times.
  std::map<std::string, std::string> Files() const {
    std::map<std::string, std::string> files;
    for (const fs::path& file : ListFiles(workspace, {"a.txt", "b", "c.txt", "verdict"})) {
      files[file] = ReadFile(workspace.root() / file);
    }
    return files;
  }

  Workspace workspace;
  RunContext context;
  std::string program = "1";
  std::string input = "pictures";
  LetterOptions a, b, c;
  std::vector<std::string> ran;
  std::function<void(const std::string& stage)> before_write = [](const std::string&) {};
  bool has_b_result = true;

 private:
  std::vector<Stage> Stages() {
    return {{"a",
             {"a.txt"},
             VisitorOf(a),
             input,
             [this](RunContext&) { return Append("a", "", "a.txt", a.repeats); },
             true},
            {"b",
             {"b"},
             VisitorOf(b),
             "",
             [this](RunContext&) {
               StageResult result = Append("b", "a.txt", "b/text", b.repeats);
               if (!has_b_result) result = {StageOutcome::kNoResult, "no letter"};
               return result;
             }},
            {"c", {"c.txt"}, VisitorOf(c), "", [this](RunContext&) {
               return Append("c", "b/text", "c.txt", c.repeats);
             }}};
  }

  StageResult Append(const std::string& name, const fs::path& from, const fs::path& to,
                     int repeats) {
    ran.push_back(name);
    std::string text = from.empty() ? "" : ReadFile(workspace.root() / from);
    for (int i = 0; i < repeats; ++i) text += name;
    WriteFileAtomic(workspace.root() / to.parent_path() / ("part_of_" + name), "half");
    before_write(name);
    fs::remove(workspace.root() / to.parent_path() / ("part_of_" + name));
    WriteFileAtomic(workspace.root() / to, text);
    return {};
  }
};

const std::map<std::string, std::string> kFinished = {
    {"a.txt", "a"}, {"b/text", "ab"}, {"c.txt", "abc"}};

TEST(RunStages, RunsOnceAndThenSkips) {
  const TempFolder folder;
  Letters letters(folder.path());
  EXPECT_EQ(letters.Run().outcome, StageOutcome::kDone);
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
  EXPECT_EQ(letters.Files(), kFinished);
  EXPECT_EQ(letters.Run().outcome, StageOutcome::kDone);
  EXPECT_THAT(letters.ran, ElementsAre("a"));  // costs nothing, always run
  EXPECT_EQ(letters.Files(), kFinished);
}

TEST(RunStages, RunsWhatAnOptionChanges) {
  const TempFolder folder;
  Letters letters(folder.path());
  (void)letters.Run();
  letters.b.repeats = 2;
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
  EXPECT_EQ(letters.Files().at("c.txt"), "abbc");
  letters.c.repeats = 3;
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "c"));
  EXPECT_EQ(letters.Files().at("c.txt"), "abbccc");
}

TEST(RunStages, RunsAllWhenInputProgramOrSeedChange) {
  const TempFolder folder;
  Letters letters(folder.path());
  (void)letters.Run();
  letters.input = "other pictures";
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
  letters.program = "2";
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
}

TEST(RunStages, RunsAgainWhereAFileIsMissingOrTouched) {
  const TempFolder folder;
  Letters letters(folder.path());
  (void)letters.Run();
  fs::remove(folder / "b/text");
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
  WriteFileAtomic(folder / "c.txt", "edited");
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "c"));
  WriteFileAtomic(folder / "b/stranger", "left over");
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
  EXPECT_EQ(letters.Files(), kFinished);
}

TEST(RunStages, ForcedRunsAgain) {
  const TempFolder folder;
  Letters letters(folder.path());
  (void)letters.Run();
  (void)letters.Run(Rerun::kAlways);
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
}

TEST(RunStages, RemovesLaterResultsThatNoLongerStand) {
  const TempFolder folder;
  Letters letters(folder.path());
  (void)letters.Run();
  WriteFileAtomic(folder / "verdict", "very good");
  letters.b.repeats = 2;
  letters.has_b_result = false;
  const StageResult result = letters.Run();
  EXPECT_EQ(result.outcome, StageOutcome::kNoResult);
  EXPECT_EQ(result.reason, "no letter");
  EXPECT_FALSE(fs::exists(folder / "c.txt"));
  EXPECT_FALSE(fs::exists(folder / "verdict"));
  const Manifest manifest = ReadManifest(letters.workspace.manifest_file());
  EXPECT_EQ(manifest.Find("b")->outcome, StageOutcome::kNoResult);
  EXPECT_EQ(manifest.Find("c"), nullptr);
}

TEST(RunStages, NotesAFailureAndLeavesNothingHalfWritten) {
  const TempFolder folder;
  Letters letters(folder.path());
  letters.before_write = [](const std::string& stage) {
    if (stage == "b") throw InvalidInputError("b", "is broken", "mend it");
  };
  EXPECT_THROW((void)letters.Run(), InvalidInputError);
  EXPECT_THAT(ListFiles(letters.workspace, {"b", "c.txt"}), IsEmpty());
  const Manifest manifest = ReadManifest(letters.workspace.manifest_file());
  EXPECT_EQ(manifest.Find("a")->outcome, StageOutcome::kDone);
  EXPECT_EQ(manifest.Find("b")->outcome, StageOutcome::kFailed);
  EXPECT_EQ(manifest.Find("b")->reason, "b: is broken; mend it");
  letters.before_write = [](const std::string&) {};
  (void)letters.Run();
  EXPECT_THAT(letters.ran, ElementsAre("a", "b", "c"));
}

TEST(RunStages, StopsOnRequestAndResumes) {
  const TempFolder folder;
  Letters letters(folder.path());
  letters.before_write = [&](const std::string& stage) {
    if (stage == "b") letters.context.RequestStop();
  };
  EXPECT_THROW((void)letters.Run(), StoppedError);
  EXPECT_EQ(ReadManifest(letters.workspace.manifest_file()).Find("c")->outcome,
            StageOutcome::kStopped);
  Letters resumed(folder.path());
  (void)resumed.Run();
  EXPECT_THAT(resumed.ran, ElementsAre("a", "c"));
  EXPECT_EQ(resumed.Files(), kFinished);
}

// The process dies without any clean-up in the middle of a stage, before or after its file is
// there.
TEST(RunStages, ResumesAfterBeingKilledAnywhere) {
  for (const std::string stage : {"a", "b", "c"}) {
    const TempFolder folder;
    const pid_t child = fork();
    if (child == 0) {
      Letters letters(folder.path());
      letters.before_write = [&](const std::string& name) {
        if (name == stage) kill(getpid(), SIGKILL);
      };
      (void)letters.Run();
      _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << stage;
    Letters resumed(folder.path());
    EXPECT_EQ(resumed.Run().outcome, StageOutcome::kDone);
    EXPECT_EQ(resumed.Files(), kFinished) << stage;
    (void)resumed.Run();
    EXPECT_THAT(resumed.ran, ElementsAre("a")) << stage;
  }
}

TEST(ProgramVersion, NamesTheVersionAndTheBuild) {
  EXPECT_THAT(ProgramVersion(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\\+[0-9a-f]+"));
}

}  // namespace
}  // namespace enfilade
