// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/structure/types.h"
#include "src/floorplan/rooms.h"

namespace enfilade {

/// Draws the outlines of the report's last storey by the paper's method, from raw counts.
void AddPaperStorey(const EvidenceGrids& evidence, const StoreyStructure& heights,
                    const std::vector<HeightSample>& samples, const FloorplanOptions& options,
                    RunContext& context, FloorplanReport& report);

}  // namespace enfilade
