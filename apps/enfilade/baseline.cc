// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/baseline.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/evaluate.h"
#include "enfilade/evaluate/overlay.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/plan_svg.h"
#include "enfilade/pipeline/draw_plan.h"
#include "enfilade/pipeline/evidence_file.h"
#include "enfilade/pipeline/gather_evidence.h"
#include "enfilade/pipeline/pipeline.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

constexpr double kLadder[] = {1, 4, 16};

constexpr const char* kFigures[] = {"area_error_gross", "area_iou_gross", "area_iou_net",
                                    "wall_plan_to_truth_median_m"};

std::string NameOf(const BaselineOptions& options) {
  const char* evidence = options.evidence == EvidenceMode::kCounts ? "" : "log_odds_";
  return fmt::format("cut_{}lambda{}", evidence, options.cut.lambda);
}

// What the plan came from: the version, the options of the stages that led to the evidence, and
// those of who drew it.
Json ProvenanceOf(const Manifest& manifest, const char* drawer, Json options) {
  PipelineOptions stage_options = OptionsOf(manifest);
  const Json stages = OptionsToJson(VisitorOf(stage_options));
  return {{"version", Version()},
          {"seed", manifest.seed},
          {"options",
           {{"structure", stages.at("structure")},
            {"evidence", stages.at("evidence")},
            {drawer, std::move(options)}}}};
}

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

RivalPlan DrawPaper(const Results& results, const std::vector<EvidenceGrids>& counts,
                    const FloorplanOptions& options, RunContext& context) {
  const Clock::time_point start = Clock::now();
  FloorplanReport report = DrawPlan(*results.scene, *results.structure, counts, options, context);
  if (report.outcome != FloorplanOutcome::kFound)
    context.log().Warning("the paper's plan has no rooms: " + report.reason);
  return {kPaperPlan, std::move(report.plan), SecondsSince(start), {}};
}

RivalPlan DrawCut(const Results& results, const std::vector<EvidenceGrids>& evidence,
                  const BaselineOptions& options, RunContext& context) {
  const Clock::time_point start = Clock::now();
  PlaneCutReport report =
      CutFloorplan(*results.scene, *results.structure, evidence, options.cut, context);
  const double seconds = SecondsSince(start);
  if (report.outcome == PlaneCutOutcome::kNoRoom)
    context.log().Warning(NameOf(options) + " has no rooms: " + report.reason);
  return {NameOf(options), std::move(report.plan), seconds, {}};
}

size_t NumRooms(const Floorplan& plan) {
  size_t count = 0;
  for (const Storey& storey : plan.storeys) count += storey.rooms.size();
  return count;
}

// A wall is an edge, so there are as many vertices.
size_t NumVertices(const Floorplan& plan) {
  size_t count = 0;
  for (const Storey& storey : plan.storeys) count += storey.walls.size();
  return count;
}

std::optional<double> FigureOf(const MetricReport& figures, const char* key) {
  const auto figure = figures.find(key);
  return figure != figures.end() ? figure->second : std::nullopt;
}

}  // namespace

std::vector<EvidenceGrids> EvidenceInMode(const Workspace& workspace, const Manifest& manifest,
                                          const Results& results, EvidenceMode mode,
                                          RunContext& context) {
  const StageRecord* record = manifest.Find("evidence");
  if (!results.structure || record == nullptr || record->outcome != StageOutcome::kDone) {
    throw InvalidInputError(workspace.root().native(), "stage 'evidence' has no result there",
                            "run 'enfilade run' or 'enfilade evidence' first");
  }
  if (mode == EvidenceMode::kLogOdds) return ReadEvidence(workspace.evidence_folder());
  GatheredEvidence gathered =
      EvidenceOf(*results.scene, *results.structure, OptionsOf(manifest).evidence, mode, context);
  if (!gathered.reason.empty())
    throw InvalidInputError(workspace.root().native(), "has no evidence", gathered.reason);
  return std::move(gathered.storeys);
}

std::vector<RivalPlan> DrawBaselines(const Workspace& workspace, const Manifest& manifest,
                                     const Results& results,
                                     const std::optional<GroundTruth>& truth,
                                     const BaselineOptions& options, RunContext& context) {
  RunContext quiet(context.num_threads(), context.seed(), context.max_memory_mb());
  std::vector<RivalPlan> rivals;
  const auto take = [&](RivalPlan rival, const Json& provenance) {
    const fs::path folder = workspace.baselines_folder() / rival.name;
    RemoveFiles(workspace, {folder.lexically_relative(workspace.root())});
    const bool has_rooms = NumRooms(rival.plan) > 0;
    if (has_rooms) WritePlan(folder, rival.plan, provenance);
    if (truth) {
      // What is said of the pictures is the same for all.
      const JudgedPlan judged =
          JudgePlan(results, rival.plan, *truth, rivals.empty() ? context : quiet);
      if (has_rooms) WriteJudgement(folder, judged, *truth);
      rival.figures = judged.report.figures;
    }
    rivals.push_back(std::move(rival));
  };
  FloorplanOptions paper = OptionsOf(manifest).floorplan;
  paper.mode = FloorplanMode::kPaper;
  paper.vertices = 0;
  take(DrawPaper(results,
                 EvidenceInMode(workspace, manifest, results, EvidenceMode::kCounts, context),
                 paper, context),
       ProvenanceOf(manifest, "floorplan", OptionsToJson(VisitorOf(paper))));
  const std::vector<EvidenceGrids> evidence =
      EvidenceInMode(workspace, manifest, results, options.evidence, context);
  for (const double factor : kLadder) {
    BaselineOptions step = options;
    step.cut.lambda *= factor;
    take(DrawCut(results, evidence, step, context),
         ProvenanceOf(manifest, "baseline", OptionsToJson(VisitorOf(step))));
  }
  return rivals;
}

std::optional<RivalPlan> OwnPlan(const Manifest& manifest, const Results& results,
                                 const std::optional<GroundTruth>& truth) {
  if (!results.floorplan) return std::nullopt;
  RivalPlan own{"floorplan", *results.floorplan, manifest.Find("floorplan")->seconds, {}};
  RunContext quiet;
  if (truth) own.figures = JudgePlan(results, own.plan, *truth, quiet).report.figures;
  return own;
}

std::string FormatRivals(const std::vector<RivalPlan>& plans) {
  std::string text = fmt::format("{:<28}", "plan");
  for (const char* key : kFigures) text += fmt::format("  {}", key);
  text += "  rooms  vertices  seconds\n";
  for (const RivalPlan& plan : plans) {
    text += fmt::format("{:<28}", plan.name);
    for (const char* key : kFigures) {
      text += fmt::format("  {:>{}}", FigureText(FigureOf(plan.figures, key)),
                          std::string_view(key).size());
    }
    text += fmt::format("  {:>5}  {:>8}  {:>7.2f}\n", NumRooms(plan.plan), NumVertices(plan.plan),
                        plan.seconds);
  }
  return text;
}

}  // namespace enfilade
