// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/child_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/fake_program.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

const std::function<void()> kDoNothing = [] {};

TEST(RunProgram, PassesArgumentsUnchanged) {
  const TempFolder folder;
  const std::string program = FakeProgram(folder / "a tool", R"(printf '<%s>' "$@")");
  const ProgramEnd end = RunProgram(program, {"two words", "", "ü\xff", "$(exit 1)", "'\""},
                                    folder / "log", kDoNothing);
  EXPECT_TRUE(end.IsSuccess());
  EXPECT_EQ(ReadFile(folder / "log"), "<two words><><ü\xff><$(exit 1)><'\">");
}

TEST(RunProgram, TellsHowItEnded) {
  const TempFolder folder;
  const auto run = [&](std::string_view body) {
    return RunProgram(FakeProgram(folder / "tool", body), {}, folder / "log", kDoNothing);
  };
  EXPECT_EQ(run("exit 3").Text(), "exit code 3");
  EXPECT_FALSE(run("exit 3").IsSuccess());
  EXPECT_EQ(run("kill -9 $$").Text(), "signal 9");
  EXPECT_FALSE(run("kill -9 $$").IsSuccess());
}

TEST(RunProgram, NeedsNoDisplayAndNoKeyboard) {
  const TempFolder folder;
  const std::string program =
      FakeProgram(folder / "tool", "cat; echo out $QT_QPA_PLATFORM; echo error >&2");
  EXPECT_TRUE(RunProgram(program, {}, folder / "log", kDoNothing).IsSuccess());
  EXPECT_EQ(ReadFile(folder / "log"), "out offscreen\nerror\n");
}

TEST(RunProgram, RefusesWhatCannotBeStarted) {
  const TempFolder folder;
  EXPECT_THROW(RunProgram(folder / "absent", {}, folder / "log", kDoNothing), DependencyError);
  WriteFileAtomic(folder / "words", "no program");
  EXPECT_THROW(RunProgram(folder / "words", {}, folder / "log", kDoNothing), DependencyError);
  fs::permissions(folder / "words", fs::perms::owner_all);
  EXPECT_THROW(RunProgram(folder / "words", {}, folder / "log", kDoNothing), DependencyError);
  EXPECT_THROW(RunProgram("/bin/true", {}, folder / "absent" / "log", kDoNothing), IoError);
}

// Waits until the file holds a line, at most ten seconds.
std::string WaitForLine(const fs::path& path) {
  for (int i = 0; i < 1000; ++i) {
    if (fs::exists(path)) {
      const std::string text = ReadFile(path);
      if (text.ends_with('\n')) return text;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return "";
}

bool IsGone(pid_t process) {
  for (int i = 0; i < 1000; ++i) {
    if (kill(process, 0) != 0) return true;
    // A killed grandchild may wait to be reaped by init.
    const std::string stat = ReadFile("/proc/" + std::to_string(process) + "/cmdline");
    if (stat.empty()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(RunProgram, IsKilledWithItsChildrenWhenTheCallerThrows) {
  const TempFolder folder;
  const std::string program = FakeProgram(
      folder / "tool", "sleep 1000 & echo $! > \"$1\"; echo $$ >> \"$1\"; echo . >> \"$1\"; wait");
  const fs::path pids = folder / "pids";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(RunProgram(program, {pids}, folder / "log",
                          [&] {
                            if (WaitForLine(pids).ends_with(".\n")) throw StoppedError();
                          }),
               StoppedError);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
  const std::string text = ReadFile(pids);
  EXPECT_TRUE(IsGone(std::stoi(text)));
  EXPECT_TRUE(IsGone(std::stoi(text.substr(text.find('\n')))));
}

TEST(RunProgram, IsKilledWhenItTakesTooLong) {
  const TempFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const ProgramEnd end = RunProgram(FakeProgram(folder / "tool", "sleep 1000"), {}, folder / "log",
                                    kDoNothing, {.seconds = 0.2});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
  EXPECT_EQ(end.excess, ProgramExcess::kTime);
  EXPECT_FALSE(end.IsSuccess());
}

TEST(RunProgram, IsKilledWhenItTakesTooMuchMemory) {
  const TempFolder folder;
  // The shell keeps what it was told: 64 MB, doubled from a kilobyte.
  const std::string program =
      FakeProgram(folder / "tool",
                  "a=$(printf %01024d 0); for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do "
                  "a=$a$a; done; exec sleep 1000");
  const ProgramEnd end =
      RunProgram(program, {}, folder / "log", kDoNothing, {.seconds = 60, .memory_mb = 40});
  EXPECT_EQ(end.excess, ProgramExcess::kMemory);
  EXPECT_GT(end.peak_memory_mb, 40);
}

TEST(RunProgram, TellsThePeakOfTheProgramAlone) {
  const TempFolder folder;
  const std::vector<char> ours(size_t{200} << 20, 'x');  // resident here while the program starts
  const ProgramEnd end = RunProgram("/bin/sleep", {"0.2"}, folder / "log", kDoNothing);
  EXPECT_TRUE(end.IsSuccess());
  EXPECT_EQ(end.excess, ProgramExcess::kNone);
  EXPECT_GT(end.peak_memory_mb, 0.1);
  EXPECT_LT(end.peak_memory_mb, 100);
  EXPECT_EQ(ours.back(), 'x');
}

TEST(FindProgram, TakesPathsAsTheyAreAndSearchesForNames) {
  const TempFolder folder;
  const std::string program = FakeProgram(folder / "tool", "exit 0");
  EXPECT_EQ(FindProgram(program), program);
  EXPECT_EQ(FindProgram(folder / "absent"), std::nullopt);
  EXPECT_EQ(FindProgram(folder.path()), std::nullopt);
  EXPECT_EQ(FindProgram(""), std::nullopt);
  EXPECT_EQ(FindProgram("no-such-program-360"), std::nullopt);
  const std::optional<fs::path> shell = FindProgram("sh");
  ASSERT_TRUE(shell.has_value());
  EXPECT_EQ(shell->filename(), "sh");
}

}  // namespace
}  // namespace enfilade
