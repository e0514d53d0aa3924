// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "apps/enfilade/reference.h"

namespace enfilade {
namespace {

struct Arguments {
  bool is_json = false;
  bool is_markdown = false;
  OptionArguments options;
};

}  // namespace

Action SetupConfig(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_flag("--json", arguments->is_json, "The options as JSON, ready for --config");
  parser.add_flag("--markdown", arguments->is_markdown, "The whole command reference as Markdown");
  PipelineOptions defaults;
  arguments->options.Register(parser, VisitorOf(defaults));
  return [arguments] {
    PipelineOptions options;
    arguments->options.Apply(VisitorOf(options));
    std::string text = OptionsReference(VisitorOf(options));
    if (arguments->is_markdown) text = CommandReference();
    if (arguments->is_json) text = OptionsToJson(VisitorOf(options)).dump(2) + "\n";
    std::fputs(text.c_str(), stdout);
    return kExitOk;
  };
}

}  // namespace enfilade
