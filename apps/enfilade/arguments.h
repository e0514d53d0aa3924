// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/enfilade/console.h"
#include "apps/enfilade/stop_on_signal.h"
#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/pipeline/options.h"
#include "enfilade/pipeline/stage.h"

namespace enfilade {

/// Arguments that every command which works takes.
struct CommonArguments {
  int num_threads = 0;
  int seed = 0;
  int max_memory_mb = 0;
  bool is_log_json = false;

  void Register(CLI::App& parser);
};

/// --config FILE and --GROUP.NAME VALUE, in the order of the command line.
class OptionArguments {
 public:
  /// Registers the options of `options` whose path starts with one of `groups` (all when empty).
  /// They are listed by 'enfilade config', not by --help.
  void Register(CLI::App& parser, const VisitFunction& options,
                const std::vector<std::string_view>& groups = {});
  /// Registers another name for one option: --camera-height for --sfm.camera_height_m.
  void RegisterAlias(CLI::App& parser, const std::string& flag, const std::string& path,
                     const std::string& help);
  /// Registers a flag without value that sets an option to true: --ordered for --sfm.ordered true.
  void RegisterFlag(CLI::App& parser, const std::string& flag, const std::string& path,
                    const std::string& help);

  [[nodiscard]] bool has_config_file() const { return !config_file_.empty(); }
  /// The first option of the command line outside `group` (of all when empty): "--GROUP.NAME";
  /// empty when there is none.
  [[nodiscard]] std::string FirstOutside(const std::string& group) const;

  /// Sets the fields from the file, then from the command line. Throws InvalidInputError or
  /// IoError.
  void Apply(const VisitFunction& options) const;

 private:
  std::string config_file_;
  std::vector<std::pair<std::string, std::string>> settings_;
};

/// Registers --points and what belongs to it.
void RegisterCloudAliases(CLI::App& parser, OptionArguments& options);

/// Context, console and signal handling of one command.
class Session {
 public:
  explicit Session(const CommonArguments& arguments);

  [[nodiscard]] RunContext& context() { return context_; }

 private:
  RunContext context_;
  StopOnSignal stop_;
};

/// Tells the user why there is no result, if there is none.
[[nodiscard]] int ExitCodeOf(const StageResult& result, Log& log);

}  // namespace enfilade
