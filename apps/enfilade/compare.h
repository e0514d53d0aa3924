// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "apps/enfilade/contenders.h"
#include "apps/enfilade/judge.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evaluate/comparison_page.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// Holds the contest of all methods on a result folder with a structure, which the caller has
/// locked, judges what they found, and writes compare/: a folder a method, comparison.json and
/// comparison.html. Returns what the page shows.
///
/// A method that fails or is given up is named with its reason; without the pictures that the run
/// saw there are no label maps, with a reason too. Throws InvalidInputError when the truth is that
/// of another home, IoError, StoppedError.
[[nodiscard]] ComparisonPage CompareMethods(const Workspace& workspace, const Manifest& manifest,
                                            Results& results,
                                            const std::optional<GroundTruth>& truth,
                                            const CompareOptions& options, RunContext& context);

}  // namespace enfilade
