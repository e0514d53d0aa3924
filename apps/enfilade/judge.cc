// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "apps/enfilade/self_check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/columns.h"
#include "enfilade/evaluate/error_map.h"
#include "enfilade/evaluate/overlay.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/obj_reader.h"
#include "enfilade/exchange/plan_svg.h"
#include "enfilade/image/codec.h"
#include "enfilade/pipeline/draw_plan.h"
#include "enfilade/pipeline/label_file.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/pipeline/structure_file.h"

namespace enfilade {

void AddCosts(const Manifest& manifest, MetricReport& figures) {
  double seconds = 0, peak_memory_mb = 0;
  for (const StageRecord& record : manifest.stages) {
    seconds += record.seconds;
    peak_memory_mb = std::max(peak_memory_mb, record.peak_memory_mb);
  }
  figures["seconds"] = seconds;
  figures["peak_memory_mb"] = peak_memory_mb;
}

namespace {

// Names of the error maps by view: the picture's stem, and some of its hash where others share it.
std::vector<std::string> ErrorMapNames(const Scene& scene) {
  const auto stem_of = [](const View& view) {
    return std::filesystem::path(view.picture).stem().native();
  };
  std::map<std::string, int> num_with_stem;
  for (const View& view : scene.views) ++num_with_stem[stem_of(view)];
  std::vector<std::string> names;
  for (const View& view : scene.views) {
    std::string name = stem_of(view);
    if (num_with_stem[name] > 1) name.append("_").append(view.sha256, 0, 8);
    names.push_back(name.append(".png"));
  }
  return names;
}

// The picture that the run was made from; empty where it is gone or another.
ImageU8 ReadPictureIfSame(const View& view) {
  std::error_code ignored;
  if (!std::filesystem::exists(view.path, ignored) || Sha256OfFile(view.path) != view.sha256) {
    return {};
  }
  return ReadImageRgb(view.path);
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
  results.scene = ReadSceneOf(workspace);
  if (is_done("structure")) results.structure = ReadStructure(workspace.structure_folder());
  if (is_done("floorplan")) results.floorplan = ReadFloorplanJson(workspace.floorplan_file());
  if (is_done("model")) results.model = ReadObj(workspace.model_obj_file());
  return results;
}

MetricReport JudgeResults(const Workspace& workspace, const Manifest& manifest,
                          const Results& results, const GroundTruth& truth, RunContext& context) {
  const Scene& scene = *results.scene;
  RemoveFiles(workspace, {workspace.error_maps_folder().filename()});
  const std::vector<std::string> map_names = ErrorMapNames(scene);
  const auto write_map = [&](const ModelErrorMap& map) {
    const auto view_idx = static_cast<size_t>(map.figures.view_idx);
    const View& view = scene.views[view_idx];
    WriteFileAtomic(workspace.error_maps_folder() / map_names[view_idx],
                    RenderErrorMapPng(map, ReadPictureIfSame(view), PrintablePath(view.picture)));
  };
  const auto label_source = [&](int view_idx) {
    return ReadLabelMaps(workspace.structure_folder(), view_idx);
  };
  const EvaluationInput input{.scene = &scene,
                              .structure = results.structure ? &*results.structure : nullptr,
                              .floorplan = results.floorplan ? &*results.floorplan : nullptr,
                              .model = results.model ? &*results.model : nullptr,
                              .label_source = label_source,
                              .model_error_sink = write_map};
  EvaluationReport report = Evaluate(input, truth, EvaluateOptions{}, context);
  AddCosts(manifest, report.figures);
  const std::optional<SelfReport> self = CheckSelf(workspace, manifest, results);
  if (self) report.figures["self_score"] = self->score;
  WriteFileAtomic(workspace.overlay_file(), RenderOverlayPng(input, truth, report));
  nlohmann::json json = ReportToJson(report);
  if (self) json["self_panoramas"] = SelfReportToJson(*self);
  WriteJsonFile(workspace.evaluation_file(), json);
  return report.figures;
}

std::string FigureText(const std::optional<double>& figure) {
  return figure ? fmt::format("{:.3f}", *figure) : "n/a";
}

JudgedResult JudgePlan(const Results& results, const Floorplan& plan, const BuildingModel* model,
                       const GroundTruth& truth, RunContext& context) {
  const EvaluationInput input{.scene = &*results.scene,
                              .structure = nullptr,
                              .floorplan = &plan,
                              .model = model,
                              .label_source = {},
                              .model_error_sink = {}};
  return {input, Evaluate(input, truth, EvaluateOptions{}, context)};
}

void WritePlan(const std::filesystem::path& folder, const Floorplan& plan,
               const nlohmann::json& provenance) {
  WritePlanSvg(folder / "plan.svg", plan);
  WriteFloorplanJson(folder / "floorplan.json", plan, provenance);
}

void WriteJudgement(const std::filesystem::path& folder, const JudgedResult& judged,
                    const GroundTruth& truth) {
  WriteFileAtomic(folder / "overlay.png", RenderOverlayPng(judged.input, truth, judged.report));
  WriteJsonFile(folder / "evaluation.json", ReportToJson(judged.report));
}

MetricReport JudgePerfectProfiles(const Workspace& workspace, const Manifest& manifest,
                                  const Results& results, const GroundTruth& truth,
                                  RunContext& context) {
  if (!results.structure) {
    throw InvalidInputError(workspace.root().native(), "holds no wall profiles",
                            "run 'enfilade run' or 'enfilade structure' first");
  }
  const Scene scene = ReadSceneWithPictures(workspace);
  const Structure structure = WithTrueProfiles(
      scene, *results.structure, truth, MatchPictures(PictureKeys(scene), PictureKeys(truth)));
  PipelineOptions options = OptionsOf(manifest);
  const Floorplan plan = PlanOf(scene, structure, options, context);
  const std::filesystem::path folder = workspace.perfect_folder();
  RemoveFiles(workspace, {folder.filename()});
  WritePlan(folder, plan,
            {{"version", Version()},
             {"seed", manifest.seed},
             {"profiles", "the truth's"},
             {"options", OptionsToJson(VisitorOf(options))}});
  const JudgedResult judged = JudgePlan(results, plan, nullptr, truth, context);
  WriteJudgement(folder, judged, truth);
  return judged.report.figures;
}

}  // namespace enfilade
