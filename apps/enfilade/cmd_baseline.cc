// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/baseline.h"
#include "apps/enfilade/command.h"
#include "apps/enfilade/rival_labels.h"
#include "enfilade/exchange/ground_truth_reader.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  std::string truth;
  CommonArguments common;
  OptionArguments options;
};

int RunBaseline(const Arguments& arguments, const BaselineOptions& options, RunContext& context) {
  const Workspace workspace(arguments.output);
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  const Results results = LoadResults(workspace, manifest);
  std::optional<GroundTruth> truth;
  if (!arguments.truth.empty())
    truth = ReadGroundTruth(arguments.truth, results.scene->camera_height_m.value_or(0));

  std::vector<RivalPlan> plans =
      DrawBaselines(workspace, manifest, results, truth, options, context);
  // The rival's: the paper's plan may have rooms where a cut has none.
  const bool has_rooms = std::any_of(plans.begin(), plans.end(), [](const RivalPlan& rival) {
    return rival.name != kPaperPlan &&
           std::any_of(rival.plan.storeys.begin(), rival.plan.storeys.end(),
                       [](const Storey& storey) { return !storey.rooms.empty(); });
  });
  if (std::optional<RivalPlan> own = OwnPlan(manifest, results, truth))
    plans.insert(plans.begin(), std::move(*own));
  const RivalLabels labels =
      MakeOrientationMaps(workspace, results, truth, options.orientation, context);
  std::fputs(FormatRivals(plans).c_str(), stdout);
  if (truth) std::fputs(FormatRivalLabels(labels).c_str(), stdout);
  return has_rooms ? kExitOk : kExitNoResult;
}

}  // namespace

Action SetupBaseline(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("OUT", arguments->output, "Result folder of a run")->required();
  parser
      .add_option("--truth", arguments->truth,
                  "Judge the plans against the truth in this folder, as 'evaluate' does")
      ->type_name("DIR");
  arguments->common.Register(parser);
  BaselineCommandOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults));
  return [arguments] {
    BaselineCommandOptions options;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    return RunBaseline(*arguments, options.baseline, session.context());
  };
}

}  // namespace enfilade
