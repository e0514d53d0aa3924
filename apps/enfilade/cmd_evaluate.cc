// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/columns.h"
#include "enfilade/evaluate/evaluate.h"
#include "enfilade/evaluate/overlay.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/exchange/scene_json.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/structure_file.h"
#include "enfilade/pipeline/workspace.h"
#include "enfilade/structure/analyze.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  std::string truth;
  bool is_ablation = false;
  CommonArguments common;
  OptionArguments options;
};

// What the stages that have run left behind.
struct Results {
  std::optional<Scene> scene;
  std::optional<Structure> structure;
  std::optional<Floorplan> floorplan;
};

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

void AddCosts(const Manifest& manifest, MetricReport& figures) {
  double seconds = 0, peak_memory_mb = 0;
  for (const StageRecord& record : manifest.stages) {
    seconds += record.seconds;
    peak_memory_mb = std::max(peak_memory_mb, record.peak_memory_mb);
  }
  figures["seconds"] = seconds;
  figures["peak_memory_mb"] = peak_memory_mb;
}

int EvaluateResults(const Workspace& workspace, const Manifest& manifest, const Results& results,
                    const GroundTruth& truth, RunContext& context) {
  const EvaluationInput input{.scene = &*results.scene,
                              .structure = results.structure ? &*results.structure : nullptr,
                              .floorplan = results.floorplan ? &*results.floorplan : nullptr};
  EvaluationReport report = Evaluate(input, truth, EvaluateOptions{}, context);
  AddCosts(manifest, report.figures);
  WriteFileAtomic(workspace.overlay_file(), RenderOverlayPng(input, truth, report));
  WriteJsonFile(workspace.evaluation_file(), ReportToJson(report));
  std::fputs(FormatReport(report.figures).c_str(), stdout);
  return kExitOk;
}

// A cue, or a set of them, alone.
struct CueSet {
  const char* name;
  bool use_floor, use_ceiling, use_correlation;
};

int PrintAblation(const Scene& scene, const GroundTruth& truth, const StructureOptions& options,
                  RunContext& context) {
  static constexpr CueSet kCueSets[] = {{"floor line", true, false, false},
                                        {"ceiling line", false, true, false},
                                        {"correlation", false, false, true},
                                        {"floor and ceiling lines", true, true, false},
                                        {"floor line and correlation", true, false, true},
                                        {"all", true, true, true}};
  const std::vector<int> truth_idx = MatchPictures(PictureKeys(scene), PictureKeys(truth));
  std::vector<AblationRow> rows;
  for (const CueSet& cues : kCueSets) {
    StructureOptions cue_options = options;
    cue_options.use_floor &= cues.use_floor;
    cue_options.use_ceiling &= cues.use_ceiling;
    cue_options.use_correlation &= cues.use_correlation;
    const StructureReport report = AnalyzeStructure(scene, cue_options, context);
    rows.push_back({cues.name, EvaluateColumns(scene, report.structure, truth, truth_idx)});
  }
  std::fputs(FormatAblation(rows).c_str(), stdout);
  return kExitOk;
}

}  // namespace

Action SetupEvaluate(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("OUT", arguments->output, "Result folder to judge")->required();
  parser
      .add_option("--truth", arguments->truth,
                  "Folder with truth/floorplan.json, floorplan.json, zind_data.json or layout.obj")
      ->required()
      ->type_name("DIR");
  parser.add_flag("--ablation", arguments->is_ablation,
                  "Instead, find the wall profiles anew with each set of cues and compare them");
  arguments->common.Register(parser);
  PipelineOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults), {"structure"});
  return [arguments] {
    PipelineOptions options;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    const Workspace workspace(arguments->output);
    const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
    const Manifest manifest = ReadManifest(workspace.manifest_file());
    const Results results = LoadResults(workspace, manifest);
    const GroundTruth truth =
        ReadGroundTruth(arguments->truth, results.scene->camera_height_m.value_or(0));
    if (arguments->is_ablation) {
      return PrintAblation(*results.scene, truth, options.structure, session.context());
    }
    return EvaluateResults(workspace, manifest, results, truth, session.context());
  };
}

}  // namespace enfilade
