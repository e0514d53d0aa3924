// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// Gives about a fifth of the rooms, at least one, a wall off the home's axes: a bay with sides at
/// 45°, or an outer wall turned by 4–15°. Rooms grow outwards only, so walls between rooms stay.
/// For homes without openings. Returns false when no room has an outer wall that allows it.
[[nodiscard]] bool AddFreeWalls(Home& home, Random& random);

/// Rounds a part of one outer wall outwards, 0.4–0.7 m deep. Returns false when none takes it.
[[nodiscard]] bool AddCurvedWall(Home& home, Random& random);

}  // namespace enfilade
