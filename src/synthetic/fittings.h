// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// Adds what also empty homes have on and before their walls, round the furniture and the cameras
/// that are there: wardrobes in bedrooms and shelves in living rooms, radiators under the windows
/// and curtains beside them, bulkheads under ceilings, boxes of movers; sockets, switches, grilles,
/// pictures and where they hung; and paint with the grain of a roller. Closets get the paint only.
void AddFittings(Home& home, Random& random);

}  // namespace enfilade
