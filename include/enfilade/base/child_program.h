// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace enfilade {

/// What a program may use before it is killed.
struct ProgramLimits {
  double seconds = std::numeric_limits<double>::infinity();
  double memory_mb = std::numeric_limits<double>::infinity();  ///< resident, 10^6 bytes
};

/// What it was killed for.
enum class ProgramExcess { kNone, kTime, kMemory };

/// How a program ended: with an exit code, or by a signal when that is not 0.
struct ProgramEnd {
  int exit_code = 0;
  int signal = 0;
  ProgramExcess excess = ProgramExcess::kNone;
  /// Most resident memory, 10^6 bytes, as it was seen every 20 ms; 0 where the system does not tell
  /// (/proc). wait4 would count the caller's too, which the child has until it becomes the program.
  double peak_memory_mb = 0;

  [[nodiscard]] bool IsSuccess() const { return exit_code == 0 && signal == 0; }
  /// "exit code 1" or "signal 9".
  [[nodiscard]] std::string Text() const;
};

/// The executable file that `program` names: itself where it holds a slash, else the first of that
/// name in the folders of PATH.
[[nodiscard]] std::optional<std::filesystem::path> FindProgram(const std::string& program);

/// Runs `program` with `arguments` (no shell; they may hold any bytes but zero) until it ends. It
/// reads nothing, writes into `log` (made anew), needs no display and dies with the calling thread.
///
/// `on_wait` is called about five times a second meanwhile. When it throws, the program and what it
/// started are killed and the exception goes on; they are killed too when the program exceeds a
/// limit, at most 20 ms later (its own memory counts, not that of what it starts). Throws
/// DependencyError when the program cannot be started, IoError when the log cannot be written.
ProgramEnd RunProgram(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments, const std::filesystem::path& log,
                      const std::function<void()>& on_wait, const ProgramLimits& limits = {});

}  // namespace enfilade
