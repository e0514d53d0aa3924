// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>
#include <string>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "apps/enfilade/synth_home.h"
#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  CommonArguments common;
  OptionArguments options;
};

std::string Describe(const Home& home, PictureKind kind) {
  const std::string places = std::to_string(home.cameras.size());
  switch (kind) {
    case PictureKind::kEquirectangular:
      return places + " panoramas";
    case PictureKind::kPerspective:
      return places + " views all round";
    case PictureKind::kVideo:
      break;
  }
  return "a video past " + places + " places";
}

}  // namespace

Action SetupSynth(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("-o,--output", arguments->output, "Folder for the home")
      ->required()
      ->type_name("OUT");
  SynthOptions defaults;
  arguments->common.Register(parser);
  arguments->options.Register(parser, VisitorOf(defaults));
  arguments->options.RegisterAlias(parser, "--preset", "home.preset",
                                   "room, flat, tour, furnished, walk, hard or building");
  arguments->options.RegisterAlias(
      parser, "--width", "pictures.width",
      "Width of the panoramas in pixels; 2048 for tour and hard, else 1024");
  const CLI::Option* seed = parser.get_option("--seed");
  return [arguments, seed] {
    SynthOptions options;
    if (seed->count() > 0) options.home.seed = arguments->common.seed;
    arguments->options.Apply(VisitorOf(options));
    Session session(arguments->common);
    const Home home = SynthesiseHome(arguments->output, options, session.context());
    const int num_storeys = home.NumStoreys();
    std::printf("%s of %zu rooms%s in %s\n", Describe(home, options.pictures.kind).c_str(),
                home.rooms.size(),
                num_storeys > 1 ? (" on " + std::to_string(num_storeys) + " storeys").c_str() : "",
                PrintablePath(arguments->output).c_str());
    return kExitOk;
  };
}

}  // namespace enfilade
