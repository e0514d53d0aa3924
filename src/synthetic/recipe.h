// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"
#include "src/synthetic/openings.h"

namespace enfilade {

enum class LayoutKind { kBlocks, kHall, kBuilding };
enum class CameraPlan { kRooms, kTour, kWalk, kBuilding };

/// Standard deviations of what is claimed about a pose.
struct PoseErrors {
  double position_m = 0;  ///< along x and along y; a tripod's height is well known
  double yaw_rad = 0;
  double tilt_rad = 0;  ///< the camera leans by this more than is claimed
};

/// What goes into the homes of a preset.
struct HomeRecipe {
  LayoutKind layout = LayoutKind::kBlocks;
  int min_rooms = 1, max_rooms = 1;
  int most_rooms = 0;  ///< that may be asked for; 0: max_rooms
  int max_storeys = 1;
  DoorMix doors;
  int num_wide_openings = 0;  ///< open plan
  int num_glass_walls = 0;    ///< glazed from floor to door height, between two rooms
  bool has_glass_door = false;
  bool has_free_walls = false;
  bool has_curved_wall = false;
  int num_niches = 0;  ///< and chimney breasts
  int num_pillars = 0;
  bool has_built_ins = false;
  bool has_cabinets_to_ceiling = false;
  bool has_fittings = false;  ///< AddFittings
  int num_mirrors = 0;
  bool has_mirror_or_low_window = false;
  double furnished_rooms = 1;
  double furniture_share = 1;        ///< of what HomeOptions asks for in these
  double min_hidden_floor_line = 0;  ///< share that furniture hides
  double sun_chance = 0;
  double lamp_light = 1;      ///< of what lights a room well: the rest is left to its windows
  double plain_ceilings = 0;  ///< share of rooms whose ceiling has the colour of the walls
  double slope_chance = 0;    ///< of one room with a sloped ceiling
  double crown_chance = 0;    ///< of a moulding under a room's ceiling
  CameraPlan cameras = CameraPlan::kRooms;
  double tilt_rad = 0;        ///< cameras lean by up to this; the claimed pose knows
  PoseErrors errors;          ///< of the claimed poses
  double exposure_stops = 0;  ///< pictures differ by up to this many stops either way
};

[[nodiscard]] HomeRecipe RecipeFor(HomePreset preset);

}  // namespace enfilade
