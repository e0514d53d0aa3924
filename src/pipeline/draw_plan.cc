// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/draw_plan.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "enfilade/floorplan/openings.h"
#include "enfilade/floorplan/room_curves.h"
#include "enfilade/floorplan/vertex_dial.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "enfilade/pipeline/gather_evidence.h"

namespace enfilade {
namespace {

// What is found once there are rooms.
void FinishFullPlan(const Scene& scene, const Structure& structure,
                    const std::vector<EvidenceGrids>& evidence, const FloorplanOptions& options,
                    RunContext& context, FloorplanReport& report) {
  Floorplan& plan = report.plan;
  const OpeningReport openings = FindOpenings(scene, options, context, plan, report.facades.get());
  report.facades.reset();
  context.log().Info(fmt::format(
      "{} doors, heads at {:.2f} m; {} wide openings, {} windows, {} closets behind shut doors",
      openings.num_doors, openings.door_head_m, openings.num_openings, openings.num_windows,
      openings.num_closets));
  AssignSigmas(scene, structure, evidence, options, plan);
  FindRoomCurves(evidence, options, context, plan);
}

void TurnDial(const FloorplanOptions& options, RunContext& context, FloorplanReport& report) {
  std::optional<Floorplan> plan =
      PlanWithVertices(report.plan, options.vertices, options.openings.max_wall_m);
  if (!plan) {
    report.outcome = FloorplanOutcome::kNoSuchNumber;
    report.reason = WhyNoSuchNumber(report.plan, options.vertices);
    return;
  }
  report.plan = *std::move(plan);
  context.log().Info(TellDial(*report.plan.dial));
}

}  // namespace

FloorplanReport DrawPlan(const Scene& scene, const Structure& structure,
                         const std::vector<EvidenceGrids>& evidence,
                         const FloorplanOptions& options, RunContext& context) {
  FloorplanReport report = SolveFloorplan(scene, structure, evidence, options, context);
  if (report.outcome != FloorplanOutcome::kFound) return report;
  if (options.mode == FloorplanMode::kFull)
    FinishFullPlan(scene, structure, evidence, options, context, report);
  if (options.vertices > 0) TurnDial(options, context, report);
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
