// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/arguments.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/enfilade/command.h"
#include "enfilade/base/json.h"

namespace enfilade {

void CommonArguments::Register(CLI::App& parser) {
  parser.add_option("--threads", num_threads, "Threads; 0: one per processor")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  parser.add_option("--seed", seed, "Seed of everything that is drawn at random")
      ->check(CLI::Range(0, 2147483647))
      ->type_name("N");
  parser.add_option("--max-memory", max_memory_mb, "Refuse work that needs more memory; 0: no cap")
      ->check(CLI::Range(0, 1 << 30))
      ->type_name("MB");
  parser.add_flag("--log-json", is_log_json, "Messages and progress as one JSON object a line");
}

void OptionArguments::Register(CLI::App& parser, const VisitFunction& options,
                               const std::vector<std::string_view>& groups) {
  parser
      .add_option("--config", config_file_, "JSON file with options (see 'enfilade config --json')")
      ->type_name("FILE");
  for (const OptionInfo& info : ListOptions(options)) {
    const bool is_wanted =
        groups.empty() || std::any_of(groups.begin(), groups.end(), [&](std::string_view group) {
          return info.path.starts_with(std::string(group) + ".");
        });
    if (!is_wanted) continue;
    RegisterAlias(parser, "--" + info.path, info.path, info.help);
    parser.get_option("--" + info.path)->group("");
  }
}

void OptionArguments::RegisterAlias(CLI::App& parser, const std::string& flag,
                                    const std::string& path, const std::string& help) {
  parser
      .add_option_function<std::string>(
          flag, [this, path](const std::string& value) { settings_.emplace_back(path, value); },
          help)
      ->type_name("VALUE");
}

void OptionArguments::RegisterFlag(CLI::App& parser, const std::string& flag,
                                   const std::string& path, const std::string& help) {
  parser.add_flag_callback(
      flag, [this, path] { settings_.emplace_back(path, "true"); }, help);
}

std::string OptionArguments::FirstOutside(const std::string& group) const {
  for (const auto& [path, value] : settings_) {
    if (group.empty() || !path.starts_with(group + ".")) return std::string("--").append(path);
  }
  return "";
}

void OptionArguments::Apply(const VisitFunction& options) const {
  if (!config_file_.empty()) OptionsFromJson(options, ReadJsonFile(config_file_), config_file_);
  for (const auto& [path, value] : settings_) SetOption(options, path, value, "command line");
}

void RegisterCloudAliases(CLI::App& parser, OptionArguments& options) {
  options.RegisterAlias(parser, "--points", "points.file",
                        "Dense cloud in the world of the poses: PLY (and .vis), .patch or .pset");
  options.RegisterAlias(parser, "--points-images", "points.images",
                        "Images that the cloud counts: COLMAP folder or list of pictures");
  options.RegisterAlias(parser, "--points-up", "points.up", "Axis of the cloud that points up");
  options.RegisterAlias(parser, "--points-scale", "points.scale",
                        "Length of the cloud's unit in that of the poses");
}

Session::Session(const CommonArguments& arguments)
    : context_(arguments.num_threads, static_cast<uint64_t>(arguments.seed),
               arguments.max_memory_mb),
      stop_(context_) {
  const Console console = MakeConsole(arguments.is_log_json ? LogFormat::kJson : LogFormat::kText);
  context_.set_log(console.log);
  context_.set_progress_sink(console.progress);
}

int ExitCodeOf(const StageResult& result, Log& log) {
  if (result.outcome != StageOutcome::kNoResult) return kExitOk;
  log.Error("no result: " + result.reason);
  return kExitNoResult;
}

}  // namespace enfilade
