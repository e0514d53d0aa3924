// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/pipeline.h"

#include <algorithm>
#include <string>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/hash.h"
#include "enfilade/exchange/scene_json.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/pipeline/memory_need.h"
#include "src/pipeline/flow.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

// What belongs to no stage and judges the result of the last one or stands beside it.
const std::vector<fs::path> kJudgements = {"evaluation.json", "overlay.png", "error_maps",
                                           "baselines"};

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

Scene ReadSceneWithPictures(const Workspace& workspace) {
  Scene scene = ReadSceneJson(workspace.scene_file());
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

  const WorkspaceLock lock(workspace, WorkspaceUse::kCreate);
  Manifest manifest = ReadManifestIfAny(workspace);
  DescribeRun(context, manifest);
  manifest.input = PrintablePath(input);
  manifest.pictures.clear();
  for (const View& view : read.scene.views) manifest.pictures[view.picture] = view.sha256;

  PipelineOptions stage_options = options;
  const std::vector<Stage> stages = MakeStages(workspace, &read.scene, stage_options);
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

  const std::string before(StageNames()[stage_idx - 1]);
  const StageRecord* record = manifest.Find(before);
  if (record == nullptr || record->outcome != StageOutcome::kDone) {
    throw InvalidInputError(workspace.root().native(), "stage '" + before + "' has no result there",
                            "run it first, or 'enfilade run'");
  }
  const std::string key_before = record->key;
  PipelineOptions stage_options = options;
  const std::vector<Stage> stages = MakeStages(workspace, nullptr, stage_options);
  return RunStages(workspace, std::span(stages).subspan(stage_idx, 1), key_before,
                   FilesFrom(stages, stage_idx + 1), Rerun::kAlways, manifest, context);
}

}  // namespace enfilade
