// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/openings.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// Cuts rooms at walls with doors that pictures show though the free space goes on through them:
/// where doors stand open, several rooms come out as one loop.
///
/// A cut is a straight wall along an axis, from side to side of a room, with wall evidence along a
/// part of it and a door's frame in it as the views in the room see it; what is neither must be
/// short. A strip as thick as a wall is taken out. `storey` has the rooms as they are, with
/// heights. What is seen of its walls, but not of cuts, is left in `facades`. Returns the polygons
/// of its rooms, in its order, the parts of a room one after the other; they do not overlap if the
/// rooms do not.
[[nodiscard]] std::vector<Polygon2> SplitRoomsAtDoors(const Scene& scene,
                                                      const Rigid3& home_from_world,
                                                      const LoopField& field, const Storey& storey,
                                                      int storey_idx, double wall_thickness_m,
                                                      const OpeningOptions& options,
                                                      FacadeStore& facades, RunContext& context);

}  // namespace enfilade
