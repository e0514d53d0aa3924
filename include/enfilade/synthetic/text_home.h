// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "enfilade/synthetic/home.h"

namespace enfilade {

struct TextHomeOptions {
  double height_m = 2.5;  ///< of rooms without `height`
  double camera_height_m = 1.5;
  double floor_z = 0;
  double heading_rad = 0;  ///< of the home's x axis in the world
  double baseboard_m = 0.07;
};

/// A home from text, for tests: parts separated by '|',
///
///   room 0,0 4,0 4,3 0,3 [height 2.6]  a room's inner outline, counter-clockwise; ids count from 0
///   hole 1,1 1,2 2,2 2,1               a pillar in the room before it, clockwise
///   door 4,1 4,1.8                     a door without leaf; its ends lie on one room's wall
///   closed 4,1 4,1.8                   a closed door
///   opening 4,1 4,2.5                  a gap without door up to 0.1 m below the ceiling
///   window 1,0 2,0                     a window
///   box 1,1 1.6,1.4 [height 0.9]       furniture between two opposite corners
///   camera 2,1.5                       a panorama; without any there is one in each room
///
/// Rooms that face each other across at most 0.5 m are joined by the doors between them. A lamp
/// hangs in every room. Example: TextHome("room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door
/// 4,1 4,1.8").
///
/// Throws std::logic_error on malformed text. The result is not checked: see HomeProblems.
[[nodiscard]] Home TextHome(std::string_view text, const TextHomeOptions& options = {});

}  // namespace enfilade
