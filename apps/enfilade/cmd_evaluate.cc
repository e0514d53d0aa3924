// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/batch.h"
#include "apps/enfilade/command.h"
#include "apps/enfilade/judge.h"
#include "apps/enfilade/self_check.h"
#include "enfilade/base/errors.h"
#include "enfilade/evaluate/columns.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/structure/analyze.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  std::string truth;
  std::string batch;
  bool is_self = false;
  bool is_ablation = false;
  bool is_perfect = false;
  CommonArguments common;
  OptionArguments options;
};

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

// Options of stages change the homes of a batch and, for structure, the ablation.
void RefuseIdleOptions(const Arguments& arguments) {
  if (!arguments.batch.empty()) return;
  const OptionArguments& options = arguments.options;
  if (arguments.is_ablation) {
    const std::string other = options.FirstOutside("structure");
    if (other.empty()) return;
    throw InvalidInputError(other, "has no effect with --ablation",
                            "give options of structure only");
  }
  const std::string idle = options.has_config_file() ? "--config" : options.FirstOutside("");
  if (idle.empty()) return;
  throw InvalidInputError(idle, "has no effect: a result is judged as it is",
                          "leave it out, or give it to the run, --ablation or --batch");
}

}  // namespace

Action SetupEvaluate(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser
      .add_option("OUT", arguments->output,
                  "Result folder to judge; with --batch, folder for all results")
      ->required();
  CLI::Option_group& against = *parser.add_option_group("Against what");
  against
      .add_option("--truth", arguments->truth,
                  "Folder with truth/floorplan.json, floorplan.json, zind_data.json or layout.obj")
      ->type_name("DIR");
  against
      .add_option("--batch", arguments->batch,
                  "Make, reconstruct and judge all homes that this file lists")
      ->type_name("MANIFEST");
  against.add_flag("--self", arguments->is_self,
                   "The run against itself: each panorama against the plan made without it");
  against.require_option(1, 2);
  against.get_option("--truth")->excludes("--batch");
  parser
      .add_flag("--ablation", arguments->is_ablation,
                "Instead, find the wall profiles anew with each set of cues and compare them")
      ->needs(against.get_option("--truth"));
  parser
      .add_flag("--perfect", arguments->is_perfect,
                "Instead, draw and judge the plan from the true wall profiles, into OUT/perfect: "
                "what it misses is not for want of better ones")
      ->needs(against.get_option("--truth"))
      ->excludes("--ablation");
  arguments->common.Register(parser);
  PipelineOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults));
  return [arguments] {
    RefuseIdleOptions(*arguments);
    PipelineOptions options;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    if (!arguments->batch.empty()) {
      return RunBatch(arguments->batch, arguments->output, options, arguments->is_self,
                      session.context());
    }
    const Workspace workspace(arguments->output);
    const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
    const Manifest manifest = ReadManifest(workspace.manifest_file());
    const Results results = LoadResults(workspace, manifest);
    if (arguments->is_self) {
      MakePlansWithoutEach(workspace, manifest, results, session.context());
      JudgeSelf(workspace, manifest, results);
    }
    if (arguments->truth.empty()) return kExitOk;
    const GroundTruth truth =
        ReadGroundTruth(arguments->truth, results.scene->camera_height_m.value_or(0));
    if (arguments->is_ablation) {
      return PrintAblation(*results.scene, truth, options.structure, session.context());
    }
    const MetricReport figures =
        arguments->is_perfect
            ? JudgePerfectProfiles(workspace, manifest, results, truth, session.context())
            : JudgeResults(workspace, manifest, results, truth, session.context());
    std::fputs(FormatReport(figures).c_str(), stdout);
    return kExitOk;
  };
}

}  // namespace enfilade
