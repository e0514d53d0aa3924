// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "apps/enfilade/compare.h"
#include "apps/enfilade/contest.h"
#include "enfilade/base/errors.h"
#include "enfilade/exchange/ground_truth_reader.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  std::string truth;
  std::string contender;
  CommonArguments common;
  OptionArguments options;
};

// The work of a process that HoldContest started; the folder is locked by who did.
int RunAsContender(const Arguments& arguments, const CompareOptions& options, RunContext& context) {
  const Workspace workspace(arguments.output);
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  const std::vector<Contender> contenders = ContendersOf(manifest, options);
  const auto contender =
      std::find_if(contenders.begin(), contenders.end(),
                   [&](const Contender& c) { return c.name == arguments.contender; });
  if (contender == contenders.end())
    throw InvalidInputError(kContenderFlag, "there is no '" + arguments.contender + "'",
                            "leave it out: compare runs all");
  RunContender(workspace, manifest, *contender, context);
  return kExitOk;
}

int RunCompare(const Arguments& arguments, const CompareOptions& options, RunContext& context) {
  const Workspace workspace(arguments.output);
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  Results results = LoadResults(workspace, manifest);
  if (!results.structure) {
    throw InvalidInputError(workspace.root().native(), "holds no wall profiles",
                            "run 'enfilade run' or 'enfilade structure' first");
  }
  std::optional<GroundTruth> truth;
  if (!arguments.truth.empty())
    truth = ReadGroundTruth(arguments.truth, results.scene->camera_height_m.value_or(0));
  const ComparisonPage page = CompareMethods(workspace, manifest, results, truth, options, context);
  std::fputs(FormatComparison(page.methods).c_str(), stdout);
  if (truth) std::fputs(FormatLabels(page.labels).c_str(), stdout);
  std::printf("the page: %s\n",
              PrintablePath(workspace.compare_folder() / "comparison.html").c_str());
  const bool is_any_found = std::any_of(
      page.methods.begin(), page.methods.end(),
      [](const ComparedMethod& method) { return method.outcome == MethodOutcome::kFound; });
  return is_any_found ? kExitOk : kExitNoResult;
}

}  // namespace

Action SetupCompare(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("OUT", arguments->output, "Result folder of a run")->required();
  parser
      .add_option("--truth", arguments->truth,
                  "Judge the methods against the truth in this folder, as 'evaluate' does")
      ->type_name("DIR");
  parser.add_option(kContenderFlag, arguments->contender)->group("");
  arguments->common.Register(parser);
  CompareCommandOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults));
  return [arguments] {
    CompareCommandOptions options;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    return arguments->contender.empty()
               ? RunCompare(*arguments, options.compare, session.context())
               : RunAsContender(*arguments, options.compare, session.context());
  };
}

}  // namespace enfilade
