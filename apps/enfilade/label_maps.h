// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "apps/enfilade/judge.h"
#include "enfilade/base/run_context.h"
#include "enfilade/baselines/orientation_map.h"
#include "enfilade/evaluate/comparison_page.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// The superpixels' labels and the orientation map of every panorama of a result folder, which the
/// caller has locked. The maps of the classification are those of the run or, where it made none
/// (structure.mode profile), found anew with its options and left in compare/labels; orientation
/// maps go to compare/orientation ("final" is the map, "free_space" the one completed by columns).
/// Both are kept for the next comparison of the same run. Pictures that are no panoramas are left
/// out. Judged where there is a truth.
///
/// Requires a structure. `results.scene` names pictures that are what the run saw. Throws
/// InvalidInputError, IoError, StoppedError.
[[nodiscard]] ComparedLabels CompareLabels(const Workspace& workspace, const Manifest& manifest,
                                           const Results& results,
                                           const std::optional<GroundTruth>& truth,
                                           const OrientationMapOptions& options,
                                           RunContext& context);

}  // namespace enfilade
