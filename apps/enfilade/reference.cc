// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/reference.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/enfilade/command.h"
#include "apps/enfilade/contenders.h"
#include "apps/enfilade/synth_home.h"
#include "enfilade/base/options.h"
#include "enfilade/pipeline/options.h"

namespace enfilade {
namespace {

// "PATH", "-o,--output DIR" or "--log-json".
std::string Spelling(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  const std::string names = option.get_name(false, true);
  return option.get_expected_max() == 0 ? names : names + " " + option.get_type_name();
}

std::vector<const CLI::App*> GroupsOf(const CLI::App& parser) {
  return parser.get_subcommands([](const CLI::App* app) { return app->get_name().empty(); });
}

// Of the options of a group exactly one must be given.
std::string UsageLine(const CLI::App& parser) {
  std::string line = "enfilade " + parser.get_name();
  for (const CLI::Option* option : parser.get_options()) {
    if (option->get_required()) line += " " + Spelling(*option);
  }
  for (const CLI::App* group : GroupsOf(parser)) {
    std::string choices;
    for (const CLI::Option* option : group->get_options()) {
      if (option == group->get_help_ptr()) continue;
      choices += (choices.empty() ? "" : " | ") + Spelling(*option);
    }
    line += " (" + choices + ")";
  }
  return line + " [options]";
}

std::string ArgumentRows(const CLI::App& parser) {
  std::string rows;
  for (const CLI::Option* option : parser.get_options()) {
    if (option->get_group().empty() || option == parser.get_help_ptr()) continue;
    rows += fmt::format("| `{}` | {} |\n", Spelling(*option), option->get_description());
  }
  for (const CLI::App* group : GroupsOf(parser)) rows += ArgumentRows(*group);
  return rows;
}

std::string CommandSection(const Command& command) {
  CLI::App parser(command.summary, command.name);
  const Action action = command.setup(parser);
  std::string text = fmt::format("## {}\n\n{}.\n\n```\n{}\n```\n", command.name, command.summary,
                                 UsageLine(parser));
  const std::string rows = ArgumentRows(parser);
  if (!rows.empty()) text += "\n| argument | meaning |\n|---|---|\n" + rows;
  return text + "\n";
}

}  // namespace

std::string CommandReference() {
  std::string text =
      "<!-- Made by 'enfilade config --markdown'; a test checks that it is current. -->\n"
      "# Command reference\n\n"
      "Exit codes: 0 done; 1 the input, an option or the environment is at fault; 2 a bug of this\n"
      "program; 3 there is no result; 128 + N stopped by signal N (130 for Ctrl-C), run again to\n"
      "resume. Messages and progress go to standard error, results to standard output.\n\n";
  for (const Command& command : Commands()) text += CommandSection(command);
  PipelineOptions defaults;
  text +=
      "## Options of the stages\n\n"
      "Each can be given as `--NAME VALUE` to `run` and to the stage that it belongs to, or in a\n"
      "JSON file with `--config FILE` (`enfilade config --json` prints one with all of them). The\n"
      "command line wins over the file.\n\n";
  text += OptionsReference(VisitorOf(defaults));
  CompareCommandOptions compare_defaults;
  text += "\n## Options of compare\n\nAs above, for `compare`.\n\n" +
          OptionsReference(VisitorOf(compare_defaults));
  SynthOptions synth_defaults;
  return text + "\n## Options of synth\n\nAs above, for `synth`.\n\n" +
         OptionsReference(VisitorOf(synth_defaults));
}

}  // namespace enfilade
