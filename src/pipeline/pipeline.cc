// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/pipeline.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/hash.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/scene_json.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/floorplan/vertex_dial.h"
#include "enfilade/pipeline/cloud.h"
#include "enfilade/pipeline/memory_need.h"
#include "src/pipeline/flow.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

// What belongs to no stage and judges or explains results, or stands beside them.
const std::vector<fs::path> kJudgements = {"evaluation.json", "overlay.png", "error_maps",
                                           "compare",         "perfect",     "explain.svg",
                                           "explain.png"};

size_t StageIndex(std::string_view name) {
  const auto names = StageNames();
  const auto it = std::find(names.begin(), names.end(), name);
  ENFILADE_CHECK(it != names.end());
  return static_cast<size_t>(it - names.begin());
}

Manifest ReadManifestIfAny(const Workspace& workspace) {
  return fs::exists(workspace.manifest_file()) ? ReadManifest(workspace.manifest_file())
                                               : Manifest{};
}

void DescribeRun(RunContext& context, Manifest& manifest) {
  manifest.program = ProgramVersion();
  manifest.num_threads = context.num_threads();
  manifest.seed = context.seed();
}

// The files of the stages from `first` on and the judgements, which no longer stand when an earlier
// stage runs again.
std::vector<fs::path> FilesFrom(const std::vector<Stage>& stages, size_t first) {
  std::vector<fs::path> files = kJudgements;
  for (size_t i = first; i < stages.size(); ++i) {
    files.insert(files.end(), stages[i].owns.begin(), stages[i].owns.end());
  }
  return files;
}

void RequirePlan(const Workspace& workspace, const Manifest& manifest) {
  if (IsStageDone(manifest, "floorplan")) return;
  throw InvalidInputError(workspace.root().native(), "holds no floorplan",
                          "run 'enfilade floorplan' or 'enfilade run' first");
}

}  // namespace

PipelineOptions OptionsOf(const Manifest& manifest) {
  PipelineOptions options;
  for (const StageRecord& record : manifest.stages) {
    for (const auto& [path, value] : record.options) {
      SetOption(VisitorOf(options), record.name + "." + path, value, "manifest.json");
    }
  }
  return options;
}

Scene ReadSceneOf(const Workspace& workspace) {
  Scene scene = ReadSceneJson(workspace.scene_file());
  if (fs::exists(workspace.cloud_file())) {
    scene.points = ReadCloudFile(workspace.cloud_file(), scene.views.size());
  }
  return scene;
}

Scene ReadSceneWithPictures(const Workspace& workspace) {
  Scene scene = ReadSceneOf(workspace);
  for (const View& view : scene.views) {
    if (Sha256OfFile(view.path) != view.sha256) {
      throw InvalidInputError(view.path.native(), "has changed since it was read",
                              "run 'enfilade run' or 'enfilade sfm' again");
    }
  }
  return scene;
}

StageResult RunPipeline(const fs::path& input, const Workspace& workspace,
                        const PipelineOptions& options, std::string_view last_stage,
                        RunContext& context) {
  const size_t num_stages = StageIndex(last_stage) + 1;
  SceneReadReport read = ReadScene(input, options.sfm.reading, context);
  RequireMemory(LeastSfmMemoryMb(read.scene, options.sfm.placing.features, context.num_threads()),
                "allow more, or give fewer pictures, fewer --threads or a smaller "
                "--sfm.features.max_features",
                context);
  if (num_stages > 1) RequireMemory(read.scene, context);

  PipelineOptions stage_options = options;
  const std::vector<Stage> stages = MakeStages(workspace, &read.scene, stage_options);

  const WorkspaceLock lock(workspace, WorkspaceUse::kCreate);
  Manifest manifest = ReadManifestIfAny(workspace);
  DescribeRun(context, manifest);
  manifest.input = PrintablePath(input);
  manifest.pictures.clear();
  for (const View& view : read.scene.views) manifest.pictures[view.picture] = view.sha256;

  return RunStages(workspace, std::span(stages).first(num_stages), "",
                   FilesFrom(stages, num_stages), Rerun::kWhenNeeded, manifest, context);
}

StageResult RunSingleStage(const Workspace& workspace, const PipelineOptions& options,
                           std::string_view stage, RunContext& context) {
  const size_t stage_idx = StageIndex(stage);
  ENFILADE_CHECK(stage_idx > 0);
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  Manifest manifest = ReadManifest(workspace.manifest_file());
  DescribeRun(context, manifest);

  // Who gives no cloud need not say so: that stage is made up for.
  const bool has_no_cloud = StageNames()[stage_idx - 1] == "points" && !manifest.Find("points");
  const size_t first_idx = has_no_cloud ? stage_idx - 1 : stage_idx;
  const std::string before(StageNames()[first_idx - 1]);
  if (!IsStageDone(manifest, before)) {
    throw InvalidInputError(workspace.root().native(), "stage '" + before + "' has no result there",
                            "run it first, or 'enfilade run'");
  }
  const std::string key_before = manifest.Find(before)->key;
  PipelineOptions stage_options = options;
  const std::vector<Stage> stages = MakeStages(workspace, nullptr, stage_options);
  return RunStages(workspace, std::span(stages).subspan(first_idx, stage_idx + 1 - first_idx),
                   key_before, FilesFrom(stages, stage_idx + 1), Rerun::kAlways, manifest, context);
}

StageResult RedrawWithVertices(const Workspace& workspace, int num_vertices, RunContext& context) {
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  Manifest manifest = ReadManifest(workspace.manifest_file());
  RequirePlan(workspace, manifest);
  const std::string where = workspace.floorplan_file().native();
  const Floorplan standing = ReadFloorplanJson(workspace.floorplan_file());
  PipelineOptions options = OptionsOf(manifest);
  options.points = {};  // its stage is not run, and its files may be gone
  options.floorplan.vertices = num_vertices;
  const std::optional<Floorplan> plan =
      PlanWithVertices(standing, num_vertices, options.floorplan.openings.max_wall_m);
  if (!plan) {
    throw InvalidInputError(where, WhyNoSuchNumber(standing, num_vertices),
                            VertexNumbers(standing).empty() ? "run 'enfilade floorplan' again"
                                                            : "ask for such a number");
  }
  context.log().Info(TellDial(*plan->dial));
  DescribeRun(context, manifest);
  const bool has_drawing = fs::exists(workspace.plan_svg_file());
  const size_t stage_idx = StageIndex("floorplan");
  const std::string key_before = manifest.Find(StageNames()[stage_idx - 1])->key;
  std::vector<Stage> stages = MakeStages(workspace, nullptr, options);
  stages[stage_idx].run = [&](RunContext&) {
    StoreFloorplan(workspace, *plan);
    return StageResult{};
  };
  const StageResult result =
      RunStages(workspace, std::span(stages).subspan(stage_idx, 1), key_before,
                FilesFrom(stages, stage_idx + 1), Rerun::kAlways, manifest, context);
  if (!has_drawing) return result;
  const std::string plan_key = manifest.Find("floorplan")->key;
  return RunStages(workspace, std::span(stages).subspan(StageIndex("export"), 1), plan_key,
                   kJudgements, Rerun::kAlways, manifest, context);
}

bool IsStageDone(const Manifest& manifest, std::string_view stage) {
  const StageRecord* record = manifest.Find(stage);
  return record != nullptr && record->outcome == StageOutcome::kDone;
}

FloorplanExplanation ExplainFloorplan(const Workspace& workspace, RunContext& context) {
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  RequirePlan(workspace, manifest);
  return SolveFromFiles(workspace, OptionsOf(manifest).floorplan, context);
}

}  // namespace enfilade
