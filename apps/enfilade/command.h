// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

namespace CLI {
class App;
}

namespace enfilade {

/// What a command does once its arguments are parsed; returns the exit code.
using Action = std::function<int()>;

/// Exit codes of the program. Interruption by a signal gives 128 + its number, as in shells.
inline constexpr int kExitOk = 0;
inline constexpr int kExitInput = 1;     ///< the input, an option or the environment is at fault
inline constexpr int kExitBug = 2;       ///< this program is at fault
inline constexpr int kExitNoResult = 3;  ///< all worked, and the answer is that there is none

/// A subcommand: `setup` registers its arguments at the parser and returns what is to be done.
struct Command {
  const char* name;
  const char* summary;
  Action (*setup)(CLI::App& parser);
};

/// All commands, the stages in flow order.
[[nodiscard]] std::span<const Command> Commands();

Action SetupRun(CLI::App& parser);
Action SetupSfm(CLI::App& parser);
Action SetupPoints(CLI::App& parser);
Action SetupStructure(CLI::App& parser);
Action SetupEvidence(CLI::App& parser);
Action SetupFloorplan(CLI::App& parser);
Action SetupModel(CLI::App& parser);
Action SetupExport(CLI::App& parser);
Action SetupEvaluate(CLI::App& parser);
Action SetupCompare(CLI::App& parser);
Action SetupSynth(CLI::App& parser);
Action SetupConfig(CLI::App& parser);
Action SetupDoctor(CLI::App& parser);
Action SetupVersion(CLI::App& parser);
Action SetupWhy(CLI::App& parser);

}  // namespace enfilade
