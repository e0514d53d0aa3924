// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/child_program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <thread>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookEvery{20};
constexpr int kLooksPerCall = 10;

// Closes on scope exit.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() { Close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int value() const { return value_; }
  void Close() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

// Null-terminated pointers into strings that outlive it, as exec wants them.
std::vector<char*> Pointers(const std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  pointers.reserve(strings.size() + 1);
  for (const std::string& string : strings) pointers.push_back(const_cast<char*>(string.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// The caller's, but Qt needs no display.
std::vector<std::string> Environment() {
  constexpr std::string_view kQtPlatform = "QT_QPA_PLATFORM=";
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string_view(*entry).starts_with(kQtPlatform)) environment.emplace_back(*entry);
  }
  environment.push_back(std::string(kQtPlatform) + "offscreen");
  return environment;
}

// All that the child needs, made before it is forked: after that, in a process of many threads,
// nothing may allocate.
struct Launch {
  const char* program;
  char* const* arguments;
  char* const* environment;
  int input, log, errors;
  pid_t parent;
};

[[noreturn]] void BecomeProgram(const Launch& launch) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const bool is_orphan = ::getppid() != launch.parent;
  if (!is_orphan && ::dup2(launch.input, STDIN_FILENO) >= 0 &&
      ::dup2(launch.log, STDOUT_FILENO) >= 0 && ::dup2(launch.log, STDERR_FILENO) >= 0) {
    ::execve(launch.program, launch.arguments, launch.environment);
  }
  const int error = errno;
  [[maybe_unused]] const ssize_t ignored = ::write(launch.errors, &error, sizeof(error));
  ::_exit(127);
}

// What kept the child from becoming the program; 0 when it became it.
int ReadStartError(int errors) {
  int error = 0;
  ssize_t count = 0;
  do {
    count = ::read(errors, &error, sizeof(error));
  } while (count < 0 && errno == EINTR);
  return count == sizeof(error) ? error : 0;
}

[[noreturn]] void ThrowStartError(const fs::path& program, int error) {
  throw DependencyError(program.native(), std::string("cannot be started: ") + std::strerror(error),
                        "name a program that this machine can run");
}

int WaitStatus(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

// The most resident memory that a process has had, in MB; 0 when the system does not tell.
double PeakMemoryMbOf(pid_t process) {
  constexpr std::string_view kKey = "VmHWM:";
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kKey)) return std::strtod(line.c_str() + kKey.size(), nullptr) * 1024e-6;
  }
  return 0;
}

// A program under way, killed with its process group on scope exit unless it ended.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (pid_ >= 0) Kill();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  ProgramEnd Wait(const std::function<void()>& on_wait, const ProgramLimits& limits) {
    const Clock::time_point start = Clock::now();
    ProgramEnd end;
    int status = 0;
    for (int looks = 0; IsRunning(status); ++looks) {
      if (looks % kLooksPerCall == 0) on_wait();
      end.peak_memory_mb = std::max(end.peak_memory_mb, PeakMemoryMbOf(pid_));
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      if (elapsed.count() > limits.seconds) end.excess = ProgramExcess::kTime;
      if (end.peak_memory_mb > limits.memory_mb) end.excess = ProgramExcess::kMemory;
      if (end.excess != ProgramExcess::kNone) {
        status = Kill();
        break;
      }
      std::this_thread::sleep_for(kLookEvery);
    }
    pid_ = -1;
    if (WIFSIGNALED(status)) {
      end.signal = WTERMSIG(status);
    } else {
      end.exit_code = WEXITSTATUS(status);
    }
    return end;
  }

 private:
  // Where the caller ignores SIGCHLD no status is to be had and `status` stays as it is.
  [[nodiscard]] bool IsRunning(int& status) const {
    const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
    return ended == 0 || (ended < 0 && errno == EINTR);
  }

  int Kill() const {
    ::kill(-pid_, SIGKILL);
    return WaitStatus(pid_);
  }

  pid_t pid_;
};

}  // namespace

std::string ProgramEnd::Text() const {
  return signal != 0 ? "signal " + std::to_string(signal)
                     : "exit code " + std::to_string(exit_code);
}

std::optional<fs::path> FindProgram(const std::string& program) {
  const auto is_executable = [](const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
  };
  if (program.find('/') != std::string::npos) {
    return is_executable(program) ? std::optional<fs::path>(program) : std::nullopt;
  }
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable != nullptr ? variable : "";
  while (!program.empty() && !folders.empty()) {
    const size_t end = std::min(folders.find(':'), folders.size());
    const fs::path candidate = fs::path(folders.substr(0, end)) / program;
    if (end > 0 && is_executable(candidate)) return candidate;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return std::nullopt;
}

ProgramEnd RunProgram(const fs::path& program, const std::vector<std::string>& arguments,
                      const fs::path& log, const std::function<void()>& on_wait,
                      const ProgramLimits& limits) {
  std::vector<std::string> all_arguments{program.native()};
  all_arguments.insert(all_arguments.end(), arguments.begin(), arguments.end());
  const std::vector<std::string> environment = Environment();
  const std::vector<char*> argument_pointers = Pointers(all_arguments);
  const std::vector<char*> environment_pointers = Pointers(environment);

  const Descriptor input(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const Descriptor output(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (output.value() < 0) {
    throw IoError(log.native(), std::string("cannot be written: ") + std::strerror(errno),
                  "check that the folder is writable and the disk has room");
  }
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) ThrowStartError(program, errno);
  const Descriptor errors(ends[0]);
  Descriptor child_errors(ends[1]);
  const Launch launch{program.c_str(), argument_pointers.data(), environment_pointers.data(),
                      input.value(),   output.value(),           child_errors.value(),
                      ::getpid()};
  const pid_t pid = ::fork();
  if (pid < 0) ThrowStartError(program, errno);
  if (pid == 0) BecomeProgram(launch);
  Child child(pid);
  child_errors.Close();
  if (const int error = ReadStartError(errors.value()); error != 0) {
    ThrowStartError(program, error);
  }
  return child.Wait(on_wait, limits);
}

}  // namespace enfilade
