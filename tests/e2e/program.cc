// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/e2e/program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <grp.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "enfilade/base/check.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

constexpr int kNobody = 65534;

// In the child: everything up to the start of the program.
[[noreturn]] void Start(const std::vector<std::string>& arguments,
                        const ProgramConditions& conditions, int out, int err) {
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  if (conditions.max_file_bytes > 0) {
    const rlimit limit{conditions.max_file_bytes, conditions.max_file_bytes};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
  }
  if (conditions.is_as_nobody &&
      (setgroups(0, nullptr) != 0 || setgid(kNobody) != 0 || setuid(kNobody) != 0)) {
    _exit(126);
  }
  std::vector<char*> argv = {const_cast<char*>(ENFILADE_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(ENFILADE_PROGRAM, argv.data());
  _exit(127);
}

int WaitAndSignal(pid_t child, const ProgramConditions& conditions) {
  bool is_sent = !conditions.signal_when;
  int status = 0;
  while (waitpid(child, &status, is_sent ? 0 : WNOHANG) == 0) {
    if (conditions.signal_when()) {
      kill(child, conditions.signal);
      is_sent = true;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return status;
}

}  // namespace

ProgramResult RunProgram(const std::vector<std::string>& arguments,
                         const ProgramConditions& conditions) {
  const TempFolder folder;
  const std::filesystem::path out_file = folder / "out", err_file = folder / "err";
  const int out = open(out_file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  const int err = open(err_file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  ENFILADE_CHECK(out >= 0 && err >= 0);
  const pid_t child = fork();
  ENFILADE_CHECK(child >= 0);
  if (child == 0) Start(arguments, conditions, out, err);
  const int status = WaitAndSignal(child, conditions);
  close(out);
  close(err);
  ProgramResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.out = ReadFile(out_file);
  result.err = ReadFile(err_file);
  return result;
}

void ExpectRefusal(const ProgramResult& result, const std::string& text) {
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  const size_t start = result.err.rfind("error: ");
  ASSERT_NE(start, std::string::npos) << result.err;
  EXPECT_TRUE(start == 0 || result.err[start - 1] == '\n') << result.err;
  EXPECT_EQ(result.err.find('\n', start), result.err.size() - 1) << result.err;
  EXPECT_THAT(result.err.substr(start), testing::HasSubstr(text));
  EXPECT_EQ(result.err.find("error: "), start) << result.err;
}

}  // namespace enfilade
