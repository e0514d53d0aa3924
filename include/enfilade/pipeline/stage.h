// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// What a stage has to say besides the files that it wrote.
struct StageResult {
  StageOutcome outcome = StageOutcome::kDone;  ///< kDone or kNoResult
  std::string reason;                          ///< for kNoResult: one line for the user
};

/// One step of the pipeline. Stages speak to each other through files alone: a stage reads what the
/// earlier ones wrote, never their memory, so a resumed run cannot differ from an unbroken one.
struct Stage {
  std::string name;
  /// Files and folders below OUT that belong to this stage and to no other.
  std::vector<std::filesystem::path> owns;
  /// The options that its result depends on.
  VisitFunction options;
  /// Hash of what it reads besides the files of earlier stages; may be empty.
  std::string inputs_hash;
  /// Writes its files and returns.
  std::function<StageResult(RunContext& context)> run;
  /// Run even when up to date: for a stage that costs nothing and writes paths, which are no part
  /// of its key.
  bool is_always_run = false;
};

/// Whether a stage whose files are up to date is run again.
enum class Rerun { kWhenNeeded, kAlways };

/// Runs `stages` in order on a locked workspace and keeps its manifest.
///
/// The key of a stage is the hash of its name, program, seed, options and inputs and of the key of
/// the stage before (for the first one: `first_key`, the key of the stage before it in the
/// manifest, or
/// ""). A stage is skipped when the manifest has it as done under the same key and its files are
/// unchanged. Otherwise its own files and those of `later_paths` and of the stages after it are
/// removed first, since they describe a result that no longer stands. The manifest is written
/// before and after each stage; a run killed at any moment continues at the stage that it was in.
///
/// Returns the result of the last stage that was run or skipped; stages after one without result
/// are not run. Whatever a stage throws is noted in the manifest and passed on.
[[nodiscard]] StageResult RunStages(const Workspace& workspace, std::span<const Stage> stages,
                                    const std::string& first_key,
                                    const std::vector<std::filesystem::path>& later_paths,
                                    Rerun rerun, Manifest& manifest, RunContext& context);

/// Version of this library: "0.1.0".
[[nodiscard]] std::string Version();

/// Version and hash of the running program: files that another build wrote are made anew.
[[nodiscard]] std::string ProgramVersion();

}  // namespace enfilade
