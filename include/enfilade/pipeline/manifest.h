// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace enfilade {

enum class StageOutcome {
  kRunning,  ///< begun; when it is found in a file, the run was killed
  kDone,
  kNoResult,  ///< the stage worked and the answer is "none", with a reason
  kFailed,
  kStopped,
};
[[nodiscard]] std::span<const std::string_view> EnumNames(StageOutcome);

/// What is known of one stage's last run.
struct StageRecord {
  std::string name;
  std::string key;  ///< hash of everything that determines the artefacts
  StageOutcome outcome = StageOutcome::kRunning;
  std::string reason;  ///< why there is no result
  double seconds = 0;
  double peak_memory_mb = 0;
  std::map<std::string, std::string> options;    ///< dotted path -> value as text
  std::map<std::string, std::string> artifacts;  ///< path relative to OUT -> SHA-256
};

/// OUT/manifest.json: what was run, with what, how long, and what came out. The only output that
/// holds times and paths.
struct Manifest {
  std::string program;  ///< version and hash of the program that wrote it last
  std::string input;    ///< PATH of the last run
  int num_threads = 0;
  uint64_t seed = 0;
  std::map<std::string, std::string> pictures;  ///< file name -> SHA-256
  std::vector<StageRecord> stages;              ///< in flow order

  /// The record called `name`, or null.
  [[nodiscard]] const StageRecord* Find(std::string_view name) const;
};

/// Reads OUT/manifest.json. Throws IoError, or InvalidInputError when it is no manifest of this
/// program.
[[nodiscard]] Manifest ReadManifest(const std::filesystem::path& path);

/// Writes atomically. Throws IoError.
void WriteManifest(const std::filesystem::path& path, const Manifest& manifest);

}  // namespace enfilade
