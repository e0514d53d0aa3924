// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/judge.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/evaluate.h"
#include "enfilade/evaluate/overlay.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/scene_json.h"
#include "enfilade/pipeline/structure_file.h"

namespace enfilade {
namespace {

void AddCosts(const Manifest& manifest, MetricReport& figures) {
  double seconds = 0, peak_memory_mb = 0;
  for (const StageRecord& record : manifest.stages) {
    seconds += record.seconds;
    peak_memory_mb = std::max(peak_memory_mb, record.peak_memory_mb);
  }
  figures["seconds"] = seconds;
  figures["peak_memory_mb"] = peak_memory_mb;
}

}  // namespace

Results LoadResults(const Workspace& workspace, const Manifest& manifest) {
  const auto is_done = [&](const char* stage) {
    const StageRecord* record = manifest.Find(stage);
    return record != nullptr && record->outcome == StageOutcome::kDone;
  };
  if (!is_done("sfm")) {
    throw InvalidInputError(workspace.root().native(), "holds no result to evaluate",
                            "run 'enfilade run' first");
  }
  Results results;
  results.scene = ReadSceneJson(workspace.scene_file());
  if (is_done("structure")) results.structure = ReadStructure(workspace.structure_folder());
  if (is_done("floorplan")) results.floorplan = ReadFloorplanJson(workspace.floorplan_file());
  return results;
}

MetricReport JudgeResults(const Workspace& workspace, const Manifest& manifest,
                          const Results& results, const GroundTruth& truth, RunContext& context) {
  const EvaluationInput input{.scene = &*results.scene,
                              .structure = results.structure ? &*results.structure : nullptr,
                              .floorplan = results.floorplan ? &*results.floorplan : nullptr};
  EvaluationReport report = Evaluate(input, truth, EvaluateOptions{}, context);
  AddCosts(manifest, report.figures);
  WriteFileAtomic(workspace.overlay_file(), RenderOverlayPng(input, truth, report));
  WriteJsonFile(workspace.evaluation_file(), ReportToJson(report));
  return report.figures;
}

}  // namespace enfilade
