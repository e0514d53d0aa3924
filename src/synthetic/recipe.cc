// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/recipe.h"

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

HomeRecipe FlatRecipe() {
  HomeRecipe recipe;
  recipe.min_rooms = 3;
  recipe.max_rooms = 5;
  recipe.max_storeys = 3;
  return recipe;
}

HomeRecipe TourRecipe() {
  HomeRecipe recipe;
  recipe.layout = LayoutKind::kHall;
  recipe.min_rooms = 5;
  recipe.max_rooms = 8;
  recipe.max_storeys = 3;
  recipe.doors = {.has_ajar = true, .closed_inner_share = 0.2};
  recipe.num_wide_openings = 2;
  recipe.has_free_walls = true;
  recipe.num_niches = 2;
  recipe.has_built_ins = true;
  recipe.has_fittings = true;
  recipe.has_mirror_or_low_window = true;
  recipe.furnished_rooms = 0.5;
  recipe.furniture_share = 0.5;
  recipe.sun_chance = 0.6;
  // With these, ceilings stand out against walls by as many grey levels as in real tours.
  recipe.lamp_light = 0.3;
  recipe.plain_ceilings = 0.5;
  recipe.slope_chance = 0.25;
  recipe.crown_chance = 0.45;
  recipe.cameras = CameraPlan::kTour;
  // Poses that a person has set by hand are this good, and nobody measures the tripod's tilt.
  recipe.errors = {.position_m = 0.02, .yaw_rad = DegToRad(0.25), .tilt_rad = DegToRad(0.2)};
  return recipe;
}

HomeRecipe FurnishedRecipe() {
  HomeRecipe recipe = FlatRecipe();
  recipe.max_storeys = 1;
  recipe.has_built_ins = true;
  recipe.min_hidden_floor_line = 0.4;
  recipe.sun_chance = 0.5;
  return recipe;
}

HomeRecipe WalkRecipe() {
  HomeRecipe recipe = FlatRecipe();
  recipe.max_storeys = 1;
  recipe.has_built_ins = true;
  recipe.cameras = CameraPlan::kWalk;
  return recipe;
}

HomeRecipe HardRecipe() {
  HomeRecipe recipe = TourRecipe();
  recipe.max_storeys = 1;
  recipe.min_rooms = 6;  // from here on there are closets
  recipe.doors.open_inner_share = 0.5;
  recipe.num_glass_walls = 1;
  recipe.has_glass_door = true;
  recipe.has_curved_wall = true;
  recipe.num_niches = 3;
  recipe.num_pillars = 1;
  recipe.has_cabinets_to_ceiling = true;
  recipe.has_mirror_or_low_window = false;
  recipe.num_mirrors = 2;
  recipe.furnished_rooms = 1;
  recipe.furniture_share = 1;
  recipe.slope_chance = 0.5;
  recipe.tilt_rad = DegToRad(2);
  recipe.exposure_stops = 0.7;
  return recipe;
}

HomeRecipe BuildingRecipe() {
  HomeRecipe recipe;
  recipe.layout = LayoutKind::kBuilding;
  recipe.min_rooms = 20;
  recipe.max_rooms = 40;
  recipe.most_rooms = 200;
  recipe.furnished_rooms = 0.25;
  recipe.cameras = CameraPlan::kBuilding;
  return recipe;
}

}  // namespace

HomeRecipe RecipeFor(HomePreset preset) {
  switch (preset) {
    case HomePreset::kRoom:
      return {};
    case HomePreset::kFlat:
      return FlatRecipe();
    case HomePreset::kTour:
      return TourRecipe();
    case HomePreset::kFurnished:
      return FurnishedRecipe();
    case HomePreset::kWalk:
      return WalkRecipe();
    case HomePreset::kHard:
      return HardRecipe();
    case HomePreset::kBuilding:
      break;
  }
  return BuildingRecipe();
}

}  // namespace enfilade
