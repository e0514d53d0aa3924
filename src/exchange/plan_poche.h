// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// The cut bodies of a storey's walls (the «poché» of a plan), openings left out.
struct WallBodies {
  MultiPolygon2 seen;      ///< of walls seen at least in part
  MultiPolygon2 inferred;  ///< of walls that no picture shows, outside `seen`
};

/// Every wall's body runs from its inner face outwards by its thickness; bodies of neighbouring
/// walls meet in a mitre, and no body covers a room.
[[nodiscard]] WallBodies BuildWallBodies(const Storey& storey);

/// The place of an opening in its wall, as far as the face of the room behind it: its two ends on
/// the wall's face, then the far ones. Empty when its wall is not in the storey.
[[nodiscard]] Ring2 OpeningFootprint(const Storey& storey, const Opening& opening);

}  // namespace enfilade
