// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Openings (without a door) wider than this make one room of the spaces that they join.
inline constexpr double kRoomJoiningOpening_m = 1.2;

/// For each room of the storey the index of the first of the rooms that wide openings make one with
/// it, directly or through others: its own index if it is the first or alone.
[[nodiscard]] std::vector<size_t> FirstJoinedRooms(const Storey& storey);

/// From an opening on the face of its wall straight to the face of the room behind it: by that
/// room's outline, as a wall may be thicker behind one part of its face than behind another; where
/// there is none within a metre, by the wall's thickness. Zero where the opening has no wall.
[[nodiscard]] Eigen::Vector2d ThroughWall(const Storey& storey, const Opening& opening);

/// For each room of the storey the floor within its openings that make it one with another: from
/// face to face, and a millimetre into both rooms so that all hang together. An opening stands with
/// the room that it names first.
[[nodiscard]] std::vector<MultiPolygon2> Passages(const Storey& storey);

}  // namespace enfilade
