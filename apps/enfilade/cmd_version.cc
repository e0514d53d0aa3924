// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/enfilade/command.h"
#include "enfilade/pipeline/stage.h"

namespace enfilade {

Action SetupVersion(CLI::App& /*parser*/) {
  return [] {
    std::printf("enfilade %s\n", ProgramVersion().c_str());
    return kExitOk;
  };
}

}  // namespace enfilade
