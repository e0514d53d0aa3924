// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "apps/enfilade/judge.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evaluate/self_score.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// Makes the plan of a result folder, locked by the caller, once more without each of its
/// panoramas, with the options of the run. The plans are left in the folder with the key of the
/// plan that they check: an interrupted check goes on where it was, and what is there is not done
/// again until another plan takes its place.
///
/// Throws InvalidInputError when the run has no plan, a picture has changed or memory is short,
/// IoError, StoppedError. Costs about a run for each panorama.
void MakePlansWithoutEach(const Workspace& workspace, const Manifest& manifest,
                          const Results& results, RunContext& context);

/// Compares each panorama with the plan made without it; none unless all those plans are there.
/// Throws InvalidInputError, IoError.
[[nodiscard]] std::optional<SelfReport> CheckSelf(const Workspace& workspace,
                                                  const Manifest& manifest, const Results& results);

/// The same for the user: writes the figures into evaluation.json, beside those against a truth if
/// there are any, and prints the panoramas, those that agree least with the plan first. Requires
/// the plans. Throws InvalidInputError, IoError.
void JudgeSelf(const Workspace& workspace, const Manifest& manifest, const Results& results);

}  // namespace enfilade
