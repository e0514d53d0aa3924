// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "enfilade/base/file.h"
#include "enfilade/evaluate/explain.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/evaluate/poses.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/exchange/scene_json.h"
#include "enfilade/pipeline/pipeline.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  int vertices = 0;
  bool is_explain = false;
  std::string explain_truth;
  CommonArguments common;
  OptionArguments options;

  [[nodiscard]] bool has_options() const {
    return options.has_config_file() || !options.FirstOutside("").empty();
  }
};

bool HoldsPlan(const Workspace& workspace) {
  return std::filesystem::exists(workspace.manifest_file()) &&
         IsStageDone(ReadManifest(workspace.manifest_file()), "floorplan");
}

// Alone, --vertices only turns the dial of the plan that stands, and --explain only explains it.
StageResult MakePlan(const Arguments& arguments, const Workspace& workspace, RunContext& context) {
  if (!arguments.has_options()) {
    if (arguments.vertices > 0) return RedrawWithVertices(workspace, arguments.vertices, context);
    if (arguments.is_explain && HoldsPlan(workspace)) return {};
  }
  PipelineOptions options;
  arguments.options.Apply(VisitorOf(options));
  if (arguments.vertices > 0) options.floorplan.vertices = arguments.vertices;
  return RunSingleStage(workspace, options, "floorplan", context);
}

// The truth is opened only when it was asked for.
struct ExplainTruth {
  std::optional<GroundTruth> truth;
  Rigid3 home_from_truth;
};

ExplainTruth ReadTruth(const std::string& folder, const Workspace& workspace,
                       const Rigid3& home_from_world) {
  ExplainTruth result;
  if (folder.empty()) return result;
  const Scene scene = ReadSceneJson(workspace.scene_file());
  result.truth = ReadGroundTruth(folder, scene.camera_height_m.value_or(0));
  Rigid3 truth_from_world;
  if (scene.pose_source == PoseSource::kEstimated) {
    truth_from_world =
        FitTruthFromWorld(JudgedCameras(scene), *result.truth,
                          MatchPictures(PictureKeys(scene), PictureKeys(*result.truth)));
  }
  result.home_from_truth = home_from_world * truth_from_world.Inverse();
  return result;
}

void Explain(const Arguments& arguments, const Workspace& workspace, RunContext& context) {
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  const FloorplanExplanation explanation = ExplainFloorplan(workspace, context);
  const Floorplan& plan = explanation.report.plan;
  const ExplainTruth truth = ReadTruth(arguments.explain_truth, workspace, plan.home_from_world);
  const ExplainInput input{plan, explanation.evidence, explanation.report.paper,
                           truth.truth ? &*truth.truth : nullptr, truth.home_from_truth};
  WriteFileAtomic(workspace.explain_svg_file(), RenderExplainSvg(input));
  WriteFileAtomic(workspace.explain_png_file(), RenderExplainPng(input));
}

}  // namespace

Action SetupFloorplan(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("OUT", arguments->output, "Result folder of an earlier stage or run")
      ->required();
  parser
      .add_option("--vertices", arguments->vertices,
                  "Corners of all rooms together; without other options the plan that stands is "
                  "drawn anew, not solved again")
      ->check(CLI::Range(4, 1000000))
      ->type_name("K");
  CLI::Option* explain = parser.add_flag(
      "--explain", arguments->is_explain,
      "Show how the plan comes about in OUT/explain.svg and explain.png; without other options of "
      "the plan that stands");
  parser
      .add_option("--explain-truth", arguments->explain_truth,
                  "Show this truth, too (as evaluate's --truth)")
      ->needs(explain)
      ->type_name("DIR");
  arguments->common.Register(parser);
  PipelineOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults), {"floorplan"});
  return [arguments] {
    Session session(arguments->common);
    const Workspace workspace(arguments->output);
    const StageResult result = MakePlan(*arguments, workspace, session.context());
    if (arguments->is_explain && result.outcome == StageOutcome::kDone)
      Explain(*arguments, workspace, session.context());
    return ExitCodeOf(result, session.context().log());
  };
}

}  // namespace enfilade
