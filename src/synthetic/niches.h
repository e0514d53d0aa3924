// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// Changes the outlines of rooms before doors are cut: niches (0.3–0.6 m deep, outer walls only)
/// and chimney breasts (0.25–0.45 m, any long wall), one a room at most. Returns false when there
/// is not space for `count`.
[[nodiscard]] bool AddNiches(Home& home, int count, Random& random);

/// Square pillars of 0.3–0.45 m, a metre or more from the walls, one in each of the largest rooms.
/// Returns false when there is not space for `count`.
[[nodiscard]] bool AddPillars(Home& home, int count, Random& random);

}  // namespace enfilade
