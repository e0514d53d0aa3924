// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// Outlines of rooms side by side, counter-clockwise, apart by walls of one thickness.
struct RoomLayout {
  std::vector<Ring2> rooms;
  Eigen::Vector2d min{0, 0}, max{0, 0};  ///< the rectangle inside the outer walls
  double wall_thickness_m = 0.12;
};

/// Fills a random rectangle with `num_rooms` rectangles and L-shapes: the largest rectangle is
/// split in two, or a room is cut from its corner, until there are enough. Rooms are at least 2.1 m
/// and arms of an L at least 1.7 m wide. None when the numbers drawn leave no space for that many.
[[nodiscard]] std::optional<RoomLayout> MakeRoomLayout(int num_rooms, Random& random);

}  // namespace enfilade
