// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/pipeline/options.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/pipeline/stage.h"
#include "enfilade/pipeline/workspace.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// All stages in flow order. The arguments must outlive the result. `scene` is what sfm is to
/// write; it may be null when sfm is not run.
[[nodiscard]] std::vector<Stage> MakeStages(const Workspace& workspace, const Scene* scene,
                                            PipelineOptions& options);

/// Solves the floorplan from what the earlier stages left. Throws InvalidInputError, IoError.
[[nodiscard]] FloorplanExplanation SolveFromFiles(const Workspace& workspace,
                                                  const FloorplanOptions& options,
                                                  RunContext& context);

/// Writes floorplan.json with what it came from, as the manifest tells.
void StoreFloorplan(const Workspace& workspace, const Floorplan& plan);

}  // namespace enfilade
