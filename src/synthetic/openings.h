// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// Two wall faces that look away from each other through one wall.
struct SharedWall {
  HomeWall wall;  ///< of the first room
  int other_room_id = 0;
  double begin_m = 0, end_m = 0;  ///< the shared stretch, along `wall` from wall.a
  double thickness_m = 0;
};

/// The wall faces of one room: outer ring before holes, ids from `first_id`.
[[nodiscard]] std::vector<HomeWall> WallsOf(const HomeRoom& room, int first_id = 0);

/// The room whose face the wall is, to be changed.
[[nodiscard]] HomeRoom& RoomOf(Home& home, const HomeWall& wall);

/// Stretches at least `min_length_m` long where parallel faces of two rooms of a storey are at most
/// `max_thickness_m` apart; each pair of faces once, first room with the smaller id.
[[nodiscard]] std::vector<SharedWall> FindSharedWalls(const Home& home, double max_thickness_m,
                                                      double min_length_m);

/// Stretches over 1 m of faces with open country behind them; other_room_id is −1.
[[nodiscard]] std::vector<SharedWall> OuterStretches(const Home& home);

struct DoorMix {
  bool has_ajar = false;            ///< one door that nobody had to go through is hardly open
  double closed_inner_share = 0.7;  ///< of the pairs of neighbours that are joined already
  double open_inner_share = 0;      ///< of the rest of these: loops of rooms
};

/// Joins the rooms by doors (0.8–0.9 m wide, 2.0 m high): a random spanning tree of passable ones
/// over those that openings join already, with an open leaf and without leaf in turn; then doors
/// between other neighbours, and a closed entrance. If the mix has one that is ajar, it leads into
/// a closet or between two rooms that are joined anyway: people open doors to take pictures.
/// Returns false when the rooms cannot be joined, no wall takes the door that is ajar, or no outer
/// wall the entrance.
[[nodiscard]] bool AddDoors(Home& home, double max_thickness_m, const DoorMix& mix, Random& random);

/// Joins every room to a corridor by one passable door, leafless, open and ajar in turn, and the
/// corridors to each other by leafless ones; then a closed entrance. Returns false when a room has
/// no corridor that takes its door.
[[nodiscard]] bool AddCorridorDoors(Home& home, double max_thickness_m, Random& random);

/// One or two windows in the outer walls of most rooms. Returns false when none has one.
[[nodiscard]] bool AddWindows(Home& home, Random& random);

/// Brings the sill of one window down to 0.15–0.35 m above the floor.
void LowerAWindow(Home& home, Random& random);

/// Turns a window into a glazed door: glass down to 3 cm above the floor.
void GlazeADoor(Home& home, Random& random);

/// Opens 1.6 m or more of the wall between two rooms that are no closets, nearly up to the ceiling.
/// Returns false when no wall is long enough.
[[nodiscard]] bool AddWideOpening(Home& home, double max_thickness_m, Random& random);

/// Glazes 1.2 m or more of the wall between two rooms that are no closets, from the floor to the
/// height of a door: a window from room to room. Returns false when no wall is long enough.
[[nodiscard]] bool AddGlassWall(Home& home, double max_thickness_m, Random& random);

}  // namespace enfilade
