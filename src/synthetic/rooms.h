// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// A room's outline, counter-clockwise, and its use where the layout settles it.
struct RoomShape {
  Ring2 ring;
  std::optional<RoomUse> use = std::nullopt;
};

/// Rooms side by side, apart by walls.
struct RoomLayout {
  std::vector<RoomShape> rooms;
  Eigen::Vector2d min{0, 0}, max{0, 0};  ///< the rectangle inside the outer walls
  double max_wall_thickness_m = 0.12;    ///< of the walls between rooms
};

/// Fills a random rectangle with `num_rooms` rectangles and L-shapes: the largest rectangle is
/// split in two, or a room is cut from its corner, until there are enough. Rooms are at least 2.1 m
/// and arms of an L at least 1.7 m wide; all walls are equally thick. None when the numbers drawn
/// leave no space for that many.
[[nodiscard]] std::optional<RoomLayout> MakeRoomLayout(int num_rooms, Random& random);

/// Two rows of rooms along a hall, of 5–8 rooms in all: the last room of one row often takes the
/// end of the hall too, and from six rooms on one or two are closets cut out of others. None when
/// the numbers drawn do not fit.
[[nodiscard]] std::optional<RoomLayout> MakeHallLayout(int num_rooms, Random& random);

/// Wings of up to 25 rooms: two rows along a corridor, wing above wing, and with more than one a
/// corridor along their ends that joins them. Corridors count as rooms and come last. None when the
/// numbers drawn do not fit; requires 8 rooms or more.
[[nodiscard]] std::optional<RoomLayout> MakeBuildingLayout(int num_rooms, Random& random);

}  // namespace enfilade
