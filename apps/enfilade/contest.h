// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/enfilade/contenders.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evaluate/comparison.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// How a contender ended and what it cost.
struct ContestRecord {
  MethodOutcome outcome = MethodOutcome::kFailed;
  std::string reason;  ///< one line; empty when there is a result
  double seconds = 0;  ///< of the method alone; of its process where that was ended
  double peak_memory_mb = 0;
  double limit = 0;  ///< seconds or MB that it was given up at; 0 where it was not
};

/// What the process of one contender does: runs it and leaves floorplan.json, plan.svg, model.obj
/// and its record in the contender's folder below compare/. Throws IoError, InvalidInputError,
/// StoppedError and what the method throws.
void RunContender(const Workspace& workspace, const Manifest& manifest, const Contender& contender,
                  RunContext& context);

/// Runs each contender in a process of its own, one after the other, with the limits of `options`,
/// and returns their records in the same order. One that was run before on the same structure, with
/// the same options and program, is not run again; of those that were given up only when the limit
/// has risen since. The caller has locked the folder. When asked to stop, ends the process at once.
/// Throws IoError, DependencyError, StoppedError.
[[nodiscard]] std::vector<ContestRecord> HoldContest(const Workspace& workspace,
                                                     const Manifest& manifest,
                                                     const std::vector<Contender>& contenders,
                                                     const CompareOptions& options,
                                                     RunContext& context);

/// The key with which a file of compare/ was made: that of the record of a contender or of a folder
/// of label maps. Empty where there is no such file or it holds none. Throws IoError,
/// InvalidInputError.
[[nodiscard]] std::string StoredKey(const std::filesystem::path& file);

/// The hidden argument of `compare` that names the contender which a process is to run.
inline constexpr const char* kContenderFlag = "--contender";

}  // namespace enfilade
