// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/join_components.h"
#include "src/sfm/component_floor.h"
#include "src/sfm/door_matches.h"

namespace enfilade {

/// A placement with what speaks for it.
struct JudgedPlacement {
  Placement placement;
  DoorSight sight;
  double log_odds = 0;
};

/// Where component b lies in the frame of a, from their matches through a door; none where no place
/// stands out. See JoinComponents.
[[nodiscard]] std::optional<JudgedPlacement> FindDoorPlacement(
    std::span<const ViewPairMatches> pairs, const ComponentFloor& a, const ComponentFloor& b,
    const JoinOptions& options, RunContext& context);

}  // namespace enfilade
