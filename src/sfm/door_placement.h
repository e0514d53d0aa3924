// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/join_components.h"
#include "src/sfm/component_floor.h"
#include "src/sfm/door_matches.h"

namespace enfilade {

/// Matches between two components for each of the four quarter turns of b that make their walls
/// parallel: what is compared differs from turn to turn.
using TurnedMatches = std::array<std::vector<ViewPairMatches>, 4>;

/// A placement with what speaks for it.
struct JudgedPlacement {
  Placement placement;
  size_t turn = 0;  ///< quarters
  DoorSight sight;
  double log_odds = 0;
};

/// Where component b lies in the frame of a, from their matches through a door; none where no place
/// stands out. See JoinComponents.
[[nodiscard]] std::optional<JudgedPlacement> FindDoorPlacement(const TurnedMatches& matches,
                                                               const ComponentFloor& a,
                                                               const ComponentFloor& b,
                                                               const JoinOptions& options,
                                                               RunContext& context);

}  // namespace enfilade
