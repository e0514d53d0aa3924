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
  std::string input;
  std::string output;
  CommonArguments common;
  OptionArguments options;
};

// 'run' and 'sfm' differ in where they end and in the options that they take.
Action SetupFromPictures(CLI::App& parser, const std::string& last_stage,
                         const std::vector<std::string_view>& groups) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("PATH", arguments->input, "Folder with the panoramas and their poses")
      ->required();
  parser.add_option("-o,--output", arguments->output, "Folder for the result")
      ->required()
      ->type_name("OUT");
  arguments->common.Register(parser);
  PipelineOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults), groups);
  arguments->options.RegisterAlias(parser, "--poses", "sfm.poses",
                                   "Pose file or COLMAP folder; none: pictures alone");
  arguments->options.RegisterAlias(parser, "--camera-height", "sfm.camera_height_m",
                                   "Height of the cameras above the floor, metres");
  arguments->options.RegisterAlias(parser, "--known-distance", "sfm.scale.known_distance",
                                   "Distance between two cameras: PICTURE,PICTURE,METRES");
  arguments->options.RegisterFlag(parser, "--ordered", "sfm.ordered",
                                  "Pictures without poses are the frames of a film, by name");
  arguments->options.RegisterAlias(parser, "--mask", "sfm.mask",
                                   "Picture (or folder of them) that is 0 where to ignore");
  if (groups.empty()) RegisterCloudAliases(parser, arguments->options);
  return [arguments, last_stage] {
    PipelineOptions options;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    const StageResult result = RunPipeline(arguments->input, Workspace(arguments->output), options,
                                           last_stage, session.context());
    return ExitCodeOf(result, session.context().log());
  };
}

}  // namespace

Action SetupRun(CLI::App& parser) { return SetupFromPictures(parser, "export", {}); }

Action SetupSfm(CLI::App& parser) { return SetupFromPictures(parser, "sfm", {"sfm"}); }

}  // namespace enfilade
