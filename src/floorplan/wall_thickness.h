// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Finds for every wall the room behind it, no farther than max_wall_m, and how thick the wall is
/// between the two faces: measured where pictures show both, else assumed. Walls without a room
/// behind keep what they have. Cost: O(walls²).
void MeasureThickness(double max_wall_m, Storey& storey);

}  // namespace enfilade
