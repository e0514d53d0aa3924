// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/pipeline/options.h"
#include "enfilade/pipeline/stage.h"
#include "enfilade/pipeline/workspace.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// All stages in flow order. The arguments must outlive the result. `scene` is what sfm is to
/// write; it may be null when sfm is not run.
[[nodiscard]] std::vector<Stage> MakeStages(const Workspace& workspace, const Scene* scene,
                                            PipelineOptions& options);

}  // namespace enfilade
