// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/contenders.h"

#include <fmt/format.h>

#include <utility>

#include "enfilade/base/json.h"
#include "enfilade/baselines/surface_points.h"
#include "enfilade/baselines/surface_report.h"
#include "enfilade/evaluate/comparison.h"
#include "enfilade/pipeline/draw_plan.h"
#include "enfilade/pipeline/gather_evidence.h"
#include "enfilade/pipeline/options.h"
#include "enfilade/pipeline/pipeline.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

constexpr double kLadder[] = {1, 4, 16};

// A plan by DrawPlan with the run's options in one of its modes.
Contender PlanInMode(std::string name, std::string title, FloorplanMode mode,
                     const PipelineOptions& run_options) {
  FloorplanOptions options = run_options.floorplan;
  // The dial of the run was set for its own plan.
  if (options.mode != mode || mode == FloorplanMode::kPaper) options.vertices = 0;
  options.mode = mode;
  EvidenceOptions evidence_options = run_options.evidence;
  Contender contender{.name = std::move(name),
                      .title = std::move(title),
                      .options = {{"evidence", OptionsToJson(VisitorOf(evidence_options))},
                                  {"floorplan", OptionsToJson(VisitorOf(options))}},
                      .needs_pictures = mode == FloorplanMode::kFull,
                      .run = {}};
  contender.run = [options, evidence_options](const Results& results, RunContext& context) {
    const GatheredEvidence gathered =
        EvidenceOf(*results.scene, *results.structure, evidence_options,
                   EvidenceModeOf(options.mode), context);
    if (!gathered.reason.empty()) return ContenderResult{gathered.reason, {}, {}};
    FloorplanReport report =
        DrawPlan(*results.scene, *results.structure, gathered.storeys, options, context);
    const bool is_found = report.outcome == FloorplanOutcome::kFound;
    return ContenderResult{is_found ? "" : report.reason, std::move(report.plan), {}};
  };
  return contender;
}

Contender PlaneCut(const PlaneCutOptions& options, EvidenceMode mode,
                   const EvidenceOptions& run_evidence) {
  PlaneCutOptions cut = options;
  EvidenceOptions evidence_options = run_evidence;
  const bool is_counts = mode == EvidenceMode::kCounts;
  Contender contender{
      .name = fmt::format("cut_{}lambda{}", is_counts ? "" : "log_odds_", cut.lambda),
      .title = fmt::format("2D cut{}, λ = {}", is_counts ? "" : " of log-odds", cut.lambda),
      .options = {{"evidence", OptionsToJson(VisitorOf(evidence_options))},
                  {"cut_evidence", EnumNames(mode)[static_cast<size_t>(mode)]},
                  {"cut", OptionsToJson(VisitorOf(cut))}},
      .needs_pictures = false,
      .run = {}};
  contender.run = [cut, mode, evidence_options](const Results& results, RunContext& context) {
    const GatheredEvidence gathered =
        EvidenceOf(*results.scene, *results.structure, evidence_options, mode, context);
    if (!gathered.reason.empty()) return ContenderResult{gathered.reason, {}, {}};
    PlaneCutReport report =
        CutFloorplan(*results.scene, *results.structure, gathered.storeys, cut, context);
    return ContenderResult{std::move(report.reason), std::move(report.plan), {}};
  };
  return contender;
}

// A method that makes a surface of the points.
template <typename Options>
Contender Surface(std::string name, std::string title, const Options& options,
                  SurfaceReport (*reconstruct)(const Scene&, const Structure&,
                                               const std::vector<ScenePoint>&, const Options&,
                                               RunContext&)) {
  Options named = options;
  Contender contender{.name = std::move(name),
                      .title = std::move(title),
                      .options = OptionsToJson(VisitorOf(named)),
                      .needs_pictures = false,
                      .run = {}};
  contender.run = [options, reconstruct](const Results& results, RunContext& context) {
    const std::vector<ScenePoint> points =
        SurfacePoints(*results.scene, *results.structure, context);
    SurfaceReport report =
        reconstruct(*results.scene, *results.structure, points, options, context);
    if (report.outcome == SurfaceOutcome::kFound)
      return ContenderResult{"", std::move(report.plan), std::move(report.model)};
    return ContenderResult{report.reason.empty() ? "there is no surface" : report.reason, {}, {}};
  };
  return contender;
}

}  // namespace

std::vector<Contender> ContendersOf(const Manifest& manifest, const CompareOptions& options) {
  const PipelineOptions run_options = OptionsOf(manifest);
  std::vector<Contender> contenders;
  contenders.push_back(
      PlanInMode(std::string(kFullSolver), "full solver", FloorplanMode::kFull, run_options));
  contenders.push_back(
      PlanInMode("paper", "the paper's method", FloorplanMode::kPaper, run_options));
  for (const double factor : kLadder) {
    PlaneCutOptions cut = options.cut;
    cut.lambda *= factor;
    contenders.push_back(PlaneCut(cut, options.cut_evidence, run_options.evidence));
  }
  contenders.push_back(Surface("volume_cut", "3D cut", options.volume_cut, CutVolume));
  contenders.push_back(Surface("poisson", "Poisson surface", options.poisson, ReconstructPoisson));
  contenders.push_back(
      Surface("polygonal", "polygonal surface", options.polygonal, ReconstructPolygonal));
  return contenders;
}

}  // namespace enfilade
