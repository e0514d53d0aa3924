// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/structure/wall_sight.h"

namespace enfilade {

/// A panorama that may stand in the same room as another.
struct RoomMate {
  int view = 0;
  double weight = 1;  ///< 0–1: how surely
};

/// For each panorama those of its room, in rising order: each sees much of the floor that the other
/// sees. Three tenths of it, as through a door, count nothing, seven tenths, as within a room
/// without corners, in full. `positions` in metres, `walls` the distances about each, as many
/// columns for all; none may be empty.
[[nodiscard]] std::vector<std::vector<RoomMate>> FindRoomMates(
    std::span<const Eigen::Vector2d> positions, std::span<const KnownDistances> walls);

}  // namespace enfilade
