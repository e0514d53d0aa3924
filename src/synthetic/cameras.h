// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"
#include "src/synthetic/recipe.h"

namespace enfilade {

/// Puts one or two cameras in every room, in the clearest of many random places. Returns false when
/// a room has no clear place.
[[nodiscard]] bool PlaceCameras(Home& home, Random& random);

/// Puts 8–12 cameras in a home as an agent would, about two a room and one or more in each that is
/// no closet: one within 0.9 m of every passable door between two such rooms, where either side has
/// a place for it; then one in every room that has none; then more where rooms have places, first
/// where there are fewest, the largest first. Returns false when there is no place for that many.
[[nodiscard]] bool PlaceTourCameras(Home& home, Random& random);

/// Puts cameras 0.4–0.5 m apart along a path through all rooms and the open doors between them, in
/// the order of the path, looking ahead. Returns false when a room cannot be walked into.
[[nodiscard]] bool PlaceWalkCameras(Home& home, Random& random);

/// Puts one camera in every room of a building and one every 4 m along its corridors. Returns false
/// when a room has no clear place.
[[nodiscard]] bool PlaceBuildingCameras(Home& home, Random& random);

/// pano_NNN.jpg, or longer for numbers from 1000 on.
[[nodiscard]] std::string PictureName(size_t number);

/// Adds an upright camera that looks along the azimuth and is called by its number.
void AddCamera(Home& home, int room_id, const Eigen::Vector3d& position, double azimuth_rad);

/// Leans every camera by up to `recipe.tilt_rad` about a random level axis, changes its exposure
/// and lets its claimed pose differ from the true one by `recipe.errors`. What the recipe does not
/// ask for stays as it is.
void DisturbCameras(Home& home, const HomeRecipe& recipe, Random& random);

/// Turns every camera, true and claimed pose alike, about its centre and a random level axis by an
/// angle uniform in [0, max_tilt_rad].
void TiltCameras(Home& home, double max_tilt_rad, Random& random);

/// Distance from `p` to the nearest wall face of its room, furniture or open leaf; negative when p
/// is not in the room. Doors count as wall: nobody sets a tripod up in one.
[[nodiscard]] double Clearance(const Home& home, int room_id, const Eigen::Vector2d& p);

}  // namespace enfilade
