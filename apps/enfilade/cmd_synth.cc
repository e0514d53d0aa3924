// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/write_home.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

struct SynthOptions {
  HomeOptions home;
  WriteHomeOptions pictures;

  SynthOptions() { pictures.width = 0; }

  void Visit(OptionVisitor& v) {
    v("home", home, "The home itself.");
    v("pictures", pictures, "Its panoramas.");
  }
};

struct Arguments {
  std::string output;
  CommonArguments common;
  OptionArguments options;
};

// An older home may be replaced, anything else not.
void CheckFolder(const fs::path& folder) {
  std::error_code error;
  const bool is_free = !fs::exists(folder, error) || fs::is_empty(folder, error);
  if (!is_free && !fs::exists(folder / "truth", error)) {
    throw InvalidInputError(folder.native(), "is not empty and is no synthetic home",
                            "choose another folder with -o");
  }
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
  arguments->options.RegisterAlias(parser, "--preset", "home.preset", "room, flat or tour");
  arguments->options.RegisterAlias(parser, "--width", "pictures.width",
                                   "Width of the panoramas in pixels; 2048 for tours, else 1024");
  const CLI::Option* seed = parser.get_option("--seed");
  return [arguments, seed] {
    SynthOptions options;
    if (seed->count() > 0) options.home.seed = arguments->common.seed;
    arguments->options.Apply(VisitorOf(options));
    if (options.pictures.width == 0) options.pictures.width = UsualWidth(options.home.preset);
    CheckFolder(arguments->output);
    Session session(arguments->common);
    const Home home = MakeHome(options.home);
    WriteHome(arguments->output, home, options.pictures, session.context());
    std::printf("%zu panoramas of %zu rooms in %s\n", home.cameras.size(), home.rooms.size(),
                PrintablePath(arguments->output).c_str());
    return kExitOk;
  };
}

}  // namespace enfilade
