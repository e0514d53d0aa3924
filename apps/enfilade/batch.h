// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/base/run_context.h"
#include "enfilade/pipeline/options.h"

namespace enfilade {

/// Makes (where the manifest says so), reconstructs and judges every home of a manifest
/// (docs/evaluation.md). Below `folder` go the made homes (homes/NAME), the results (results/NAME)
/// and the tables batch.json, batch.csv and batch.md, which are written anew after each home. What
/// is there already is not done again. A home that fails has its reason in the tables, and the
/// others go on. With `is_self` each home is also checked against itself (self_check.h).
///
/// Returns the exit code: kExitNoResult when a home failed. Throws InvalidInputError for a broken
/// manifest, IoError when the tables cannot be written, StoppedError.
[[nodiscard]] int RunBatch(const std::filesystem::path& manifest_file,
                           const std::filesystem::path& folder, const PipelineOptions& options,
                           bool is_self, RunContext& context);

}  // namespace enfilade
