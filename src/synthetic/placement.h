// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// A door leaf swung open, as a box; its footprint also is where nothing else may stand.
[[nodiscard]] HomeBox OpenLeaf(const HomeOpening& door);

/// Floor that must stay free so that a door can be walked through: on both sides, 0.9 m deep; leaf
/// included.
[[nodiscard]] MultiPolygon2 DoorClearance(const HomeOpening& door);

struct FurnitureShare {
  double of_pieces = 0.5;  ///< that a room may hold
  double of_rooms = 1;     ///< that are furnished
};

/// Puts a share of what rooms may hold where it fits: against walls, clear of doors, of what stands
/// there and, if tall, of windows. Items of `home.boxes` stay.
void FurnishRooms(Home& home, const FurnitureShare& share, Random& random);

/// Hangs a mirror on a wall of some room that is no closet, where it is not in the way of a door.
/// Returns false when no place was found.
[[nodiscard]] bool HangMirror(Home& home, Random& random);

/// Puts one or two cameras in every room, in the clearest of many random places. Returns false when
/// a room has no clear place.
[[nodiscard]] bool PlaceCameras(Home& home, Random& random);

/// Puts 8–12 cameras in a home as an agent would: one in every room but closets, then more where
/// there is most floor for each. Returns false when there is no place for that many.
[[nodiscard]] bool PlaceTourCameras(Home& home, Random& random);

/// Adds an upright camera that looks along the azimuth and is called pano_NNN.jpg by its number.
void AddCamera(Home& home, int room_id, const Eigen::Vector3d& position, double azimuth_rad);

/// Hangs a lamp of the given radiance under the ceiling of every room, farthest from its walls.
void HangLamps(Home& home, const std::vector<float>& radiance);

/// Distance from `p` to the nearest wall face of its room, furniture or open leaf; negative when p
/// is not in the room.
[[nodiscard]] double Clearance(const Home& home, int room_id, const Eigen::Vector2d& p);

}  // namespace enfilade
