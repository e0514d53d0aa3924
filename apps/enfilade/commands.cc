// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "apps/enfilade/command.h"

namespace enfilade {

std::span<const Command> Commands() {
  static constexpr std::array kCommands = {
      Command{"doctor", "Check memory, disk, pictures and helpers before starting", SetupDoctor},
      Command{"config", "List every option of every stage", SetupConfig},
      Command{"version", "Print the version", SetupVersion},
  };
  return kCommands;
}

}  // namespace enfilade
