// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "apps/enfilade/command.h"

namespace enfilade {

std::span<const Command> Commands() {
  static constexpr std::array kCommands = {
      Command{"run", "Do everything: from pictures to plan and model; continue where it was",
              SetupRun},
      Command{"sfm", "Read pictures and poses into a scene", SetupSfm},
      Command{"points", "Take a dense cloud of points that was made elsewhere", SetupPoints},
      Command{"structure", "Find directions, heights and wall profiles", SetupStructure},
      Command{"evidence", "Gather wall and free-space evidence", SetupEvidence},
      Command{"floorplan", "Draw the rooms", SetupFloorplan},
      Command{"model", "Raise the plan to a model", SetupModel},
      Command{"export", "Write the drawings", SetupExport},
      Command{"evaluate", "Judge a result against the truth", SetupEvaluate},
      Command{"compare", "Hold the result beside what rival methods make of the same evidence",
              SetupCompare},
      Command{"why", "Show the evidence for a wall", SetupWhy},
      Command{"synth", "Make a home with its panoramas and its truth", SetupSynth},
      Command{"doctor", "Check memory, disk, pictures and helpers before starting", SetupDoctor},
      Command{"config", "List every option of every stage", SetupConfig},
      Command{"version", "Print the version", SetupVersion},
  };
  return kCommands;
}

}  // namespace enfilade
