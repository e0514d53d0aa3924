// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "enfilade/pipeline/pipeline.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  CommonArguments common;
  OptionArguments options;
};

Action SetupStage(CLI::App& parser, const std::string& stage) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("OUT", arguments->output, "Result folder of an earlier stage or run")
      ->required();
  arguments->common.Register(parser);
  PipelineOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults), {stage});
  if (stage == "points") RegisterCloudAliases(parser, arguments->options);
  return [arguments, stage] {
    PipelineOptions options;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    const StageResult result =
        RunSingleStage(Workspace(arguments->output), options, stage, session.context());
    return ExitCodeOf(result, session.context().log());
  };
}

}  // namespace

Action SetupPoints(CLI::App& parser) { return SetupStage(parser, "points"); }
Action SetupStructure(CLI::App& parser) { return SetupStage(parser, "structure"); }
Action SetupEvidence(CLI::App& parser) { return SetupStage(parser, "evidence"); }
Action SetupModel(CLI::App& parser) { return SetupStage(parser, "model"); }
Action SetupExport(CLI::App& parser) { return SetupStage(parser, "export"); }

}  // namespace enfilade
