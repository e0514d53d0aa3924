// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/draw_plan.h"

#include <fmt/format.h>

#include "enfilade/floorplan/openings.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "enfilade/pipeline/gather_evidence.h"

namespace enfilade {

FloorplanReport DrawPlan(const Scene& scene, const Structure& structure,
                         const std::vector<EvidenceGrids>& evidence,
                         const FloorplanOptions& options, RunContext& context) {
  FloorplanReport report = SolveFloorplan(scene, structure, evidence, options, context);
  if (options.mode == FloorplanMode::kPaper || report.outcome != FloorplanOutcome::kFound)
    return report;
  const OpeningReport openings = FindOpenings(scene, options.openings, context, report.plan);
  context.log().Info(fmt::format("{} doors, heads at {:.2f} m; {} wide openings, {} windows",
                                 openings.num_doors, openings.door_head_m, openings.num_openings,
                                 openings.num_windows));
  AssignSigmas(scene, structure, evidence, options, report.plan);
  return report;
}

Floorplan PlanOf(const Scene& scene, const Structure& structure, const PipelineOptions& options,
                 RunContext& context) {
  const GatheredEvidence evidence = EvidenceOf(scene, structure, options.evidence,
                                               EvidenceModeOf(options.floorplan.mode), context);
  if (!evidence.reason.empty()) return {};
  return DrawPlan(scene, structure, evidence.storeys, options.floorplan, context).plan;
}

}  // namespace enfilade
