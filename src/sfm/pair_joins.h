// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/sfm/join_components.h"
#include "src/sfm/component_floor.h"

namespace enfilade {

/// Places of components beside each other that pairs of their panoramas tell (EstimatePair) which
/// had too few digits to be believed. What agrees falsely mostly lays one room upon a like one. So
/// places at which the rooms' outlines lie on each other do not count, unless neither panorama sees
/// a wall before the other's walls, as in one room; and of the others fewer digits are enough.
/// Pairs that tell one place count together, and of all that counts no more than half as much may
/// speak against it. At most one place for two components.
[[nodiscard]] std::vector<ComponentJoin> JoinsOfPairs(const UnjoinedComponents& components,
                                                      std::span<const ComponentFloor> floors,
                                                      const JoinOptions& options);

}  // namespace enfilade
