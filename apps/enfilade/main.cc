// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/enfilade/command.h"
#include "apps/enfilade/stop_on_signal.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/log.h"
#include "enfilade/base/options.h"

namespace enfilade {
namespace {

// A usage error: what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Every word that would have been understood where `parser` stopped.
std::vector<std::string> KnownWords(const CLI::App& parser) {
  std::vector<std::string> words;
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  for (const CLI::App* command : parser.get_subcommands({})) words.push_back(command->get_name());
  return words;
}

// A word that nobody knows explains most other complaints of the parser, so it goes first.
std::string UsageProblem(const CLI::App& parser, const CLI::ParseError& error) {
  for (const std::string& word : parser.remaining()) {
    const bool is_flag = word.starts_with("-");
    if (!is_flag && !parser.get_subcommands({}).size()) continue;
    const std::string nearest = NearestWord(word, KnownWords(parser));
    return "there is no " + std::string(is_flag ? "option" : "command") + " '" + word + "'" +
           (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
  }
  std::string problem = error.what();
  std::replace(problem.begin(), problem.end(), '\n', ' ');
  return problem;
}

int ParseAndRun(int argc, char** argv) {
  CLI::App parser("Measured floorplans and textured models from 360° panoramas", "enfilade");
  parser.footer("'enfilade COMMAND --help' tells more about a command.");
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const Command& command : Commands()) {
    CLI::App* subparser = parser.add_subcommand(command.name, command.summary);
    actions.emplace_back(subparser, command.setup(*subparser));
  }
  if (argc == 1) {
    std::fputs(parser.help().c_str(), stdout);
    return kExitOk;
  }
  try {
    parser.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return parser.exit(success);
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = parser.get_subcommands();
    const CLI::App& where = chosen.empty() ? parser : *chosen.front();
    throw UsageError(UsageProblem(where, error) + " (see '" +
                     (chosen.empty() ? "enfilade" : "enfilade " + where.get_name()) + " --help')");
  }
  for (const auto& [subparser, action] : actions) {
    if (subparser->parsed()) return action();
  }
  throw UsageError("name a command (see 'enfilade --help')");
}

// The one place where errors end: one line each, and the exit code.
int RunProgram(int argc, char** argv, Log& log) {
  try {
    return ParseAndRun(argc, argv);
  } catch (const UsageError& error) {
    log.Error(error.what());
    return kExitInput;
  } catch (const UserError& error) {
    log.Error(error.what());
    return kExitInput;
  } catch (const StoppedError&) {
    log.Warning("stopped; run the same command again to resume");
    return 128 + StopSignal();
  } catch (const std::bad_alloc&) {
    log.Error(
        "memory: there is not enough; close other programs, give smaller pictures or fewer "
        "--threads");
    return kExitInput;
  } catch (const std::filesystem::filesystem_error& error) {
    log.Error(PrintablePath(error.path1()) + ": " + error.code().message());
    return kExitInput;
  } catch (const std::system_error& error) {
    log.Error(std::string("the system refuses: ") + error.what() + "; free memory or threads");
    return kExitInput;
  } catch (const std::exception& error) {
    log.Error(std::string("this is a bug of enfilade, please report it: ") + error.what());
    return kExitBug;
  }
}

}  // namespace
}  // namespace enfilade

int main(int argc, char** argv) {
  using namespace std::string_view_literals;
  // Writing beyond a file size limit then fails with an error that names the file.
  std::signal(SIGXFSZ, SIG_IGN);
  const bool is_json = std::find(argv, argv + argc, "--log-json"sv) != argv + argc;
  const auto log = enfilade::MakeStderrLog(
      enfilade::LogLevel::kInfo, is_json ? enfilade::LogFormat::kJson : enfilade::LogFormat::kText);
  return enfilade::RunProgram(argc, argv, *log);
}
