// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/baselines/plane_cut.h"
#include "enfilade/evidence/types.h"
#include "enfilade/optim/grid_cut.h"

namespace enfilade {

/// The cut of one storey, inside being the source's side.
[[nodiscard]] GridCutProblem MakeCutProblem(const EvidenceGrids& evidence,
                                            const PlaneCutOptions& options);

}  // namespace enfilade
