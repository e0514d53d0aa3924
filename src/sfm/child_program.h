// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace enfilade {

/// How a program ended: with an exit code, or by a signal when that is not 0.
struct ProgramEnd {
  int exit_code = 0;
  int signal = 0;

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
/// started are killed and the exception goes on. Throws DependencyError when the program cannot be
/// started, IoError when the log cannot be written.
ProgramEnd RunProgram(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments, const std::filesystem::path& log,
                      const std::function<void()>& on_wait);

}  // namespace enfilade
