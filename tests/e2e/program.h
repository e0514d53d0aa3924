// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace enfilade {

/// How the program is run and what is done to it.
struct ProgramConditions {
  bool is_as_nobody = false;    ///< give up root's rights first; needs root
  uint64_t max_file_bytes = 0;  ///< larger files cannot be written, as on a full disk; 0: no limit
  std::function<bool()> signal_when;  ///< asked all the time; once true, `signal` is sent
  int signal = 0;
};

struct ProgramResult {
  int exit_code = -1;  ///< −1 when a signal ended it
  int signal = 0;      ///< that ended it
  std::string out;
  std::string err;
};

/// Runs the enfilade program of this build and waits for its end.
[[nodiscard]] ProgramResult RunProgram(const std::vector<std::string>& arguments,
                                       const ProgramConditions& conditions = {});

/// Expects what every refusal must be: the exit code 1, nothing on standard output, and as the last
/// thing on standard error one line that starts with "error: " and contains `text`.
void ExpectRefusal(const ProgramResult& result, const std::string& text);

}  // namespace enfilade
