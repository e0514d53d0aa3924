// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/pipeline/options.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// SolveFloorplan, then FindOpenings, AssignSigmas and FindRoomCurves; in the paper's mode without
/// these three. Where FloorplanOptions::vertices asks for it, PlanWithVertices; without such a plan
/// the outcome is kNoSuchNumber.
/// Throws what reading pictures throws.
[[nodiscard]] FloorplanReport DrawPlan(const Scene& scene, const Structure& structure,
                                       const std::vector<EvidenceGrids>& evidence,
                                       const FloorplanOptions& options, RunContext& context);

/// The plan that the stages after structure make: evidence, cores and DrawPlan, each with its
/// options. Empty when they find none. Throws what AccumulateEvidence and DrawPlan throw.
[[nodiscard]] Floorplan PlanOf(const Scene& scene, const Structure& structure,
                               const PipelineOptions& options, RunContext& context);

}  // namespace enfilade
