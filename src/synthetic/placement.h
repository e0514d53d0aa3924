// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/furniture.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// A door leaf swung open, as a box; its footprint also is where nothing else may stand.
[[nodiscard]] HomeBox OpenLeaf(const HomeOpening& door);

/// Floor that must stay free so that a door can be walked through: on both sides, 0.9 m deep; leaf
/// included.
[[nodiscard]] std::vector<Ring2> DoorClearance(const HomeOpening& door);

/// Where a piece stands: its back's middle and its heading.
struct PieceStand {
  Eigen::Vector2d origin{0, 0};
  double yaw_rad = 0;
};

/// What a piece covers of the floor, with a margin at its sides and before it.
[[nodiscard]] Ring2 PieceFootprint(const FurniturePiece& piece, const PieceStand& stand,
                                   double margin_m);

/// Adds the boxes of a piece, an item of their own, without looking whether there is room.
void AddPiece(Home& home, const HomeRoom& room, const FurniturePiece& piece,
              const PieceStand& stand);

struct FurnitureShare {
  double of_pieces = 0.5;  ///< that a room may hold
  double of_rooms = 1;     ///< that are furnished
};

/// Puts a share of what rooms may hold where it fits: against walls, clear of doors, of what stands
/// there and, if tall, of windows. Items of `home.boxes` stay.
void FurnishRooms(Home& home, const FurnitureShare& share, Random& random);

/// Fits out kitchens, baths and closets: what stays when the furniture is gone. With
/// `has_cabinets_to_ceiling` other rooms get cabinets from floor to ceiling: returns false when
/// none of them fits.
[[nodiscard]] bool BuildIn(Home& home, bool has_cabinets_to_ceiling, Random& random);

/// Adds furniture round the cameras that are there until it hides the share of the floor line that
/// HiddenFloorLineShare measures. Returns false when it does not.
[[nodiscard]] bool HideFloorLine(Home& home, double min_share, Random& random);

/// Hangs a mirror on a wall of some room that is no closet, where it is not in the way of a door.
/// Returns false when no place was found.
[[nodiscard]] bool HangMirror(Home& home, Random& random);

/// Hangs a lamp of the given radiance under the ceiling of every room, farthest from its walls.
void HangLamps(Home& home, const std::vector<float>& radiance);

/// Gives every corridor, instead of its lamp, weaker ones every 6 m along it. Its ceiling must be
/// level.
void SpreadCorridorLamps(Home& home);

}  // namespace enfilade
