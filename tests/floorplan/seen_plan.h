// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// Two rooms beside each other, an L and a box behind a wall of 10 cm, each with a panorama whose
/// profile is perfect. A passage leads through the wall between them if there is one.
struct SeenPlan {
  Floorplan plan;
  Scene scene;
  Structure structure;
  EvidenceGrids evidence;

  size_t num_walls_of_first_room = 6;
  size_t along_both = 0;  ///< wall 0, 4 m: goes on in the second room
  size_t partition = 1;   ///< wall 1, 3 m: between the rooms
  size_t outer = 5;       ///< wall 5, 4 m: nothing behind it, no other on its line
  size_t far_wall = 7;    ///< of the second room, across the passage
  double camera_to_partition_m = 2;
  double second_room_width_m = 2.9;
};

/// The rooms turned about the origin.
[[nodiscard]] SeenPlan MakeSeenPlan(double angle_rad, bool has_passage = false);

}  // namespace enfilade
