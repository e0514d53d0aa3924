// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/home.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "src/synthetic/cameras.h"
#include "src/synthetic/fittings.h"
#include "src/synthetic/free_walls.h"
#include "src/synthetic/niches.h"
#include "src/synthetic/openings.h"
#include "src/synthetic/placement.h"
#include "src/synthetic/recipe.h"
#include "src/synthetic/rooms.h"
#include "src/synthetic/storeys.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

// Parts of a home whose numbers come from streams of their own.
// Upper storeys take one number each.
enum class SeedPart : uint64_t {
  kRoomCount = 4001,
  kWetRooms,
  kUpperStoreys,
  kFittings = 4101,
  kTilt
};

std::optional<RoomLayout> MakeLayout(const HomeRecipe& recipe, int asked_rooms, uint64_t seed,
                                     Random& random) {
  Random count(PartSeed(seed, static_cast<uint64_t>(SeedPart::kRoomCount)));
  const int drawn = recipe.min_rooms + count.Index(recipe.max_rooms - recipe.min_rooms + 1);
  const int num_rooms = asked_rooms > 0 ? asked_rooms : drawn;
  switch (recipe.layout) {
    case LayoutKind::kBlocks:
      return MakeRoomLayout(num_rooms, random);
    case LayoutKind::kHall:
      return MakeHallLayout(num_rooms, random);
    case LayoutKind::kBuilding:
      break;
  }
  return MakeBuildingLayout(num_rooms, random);
}

void AddRooms(Home& home, const RoomLayout& layout, Random& random) {
  const Vector2d shift =
      Vector2d(random.Millimetres(-2, 2), random.Millimetres(-2, 2)) - 0.5 * layout.max;
  const double floor_z = random.Millimetres(-0.3, 0.3);
  for (const RoomShape& outline : layout.rooms) {
    HomeRoom room;
    room.id = static_cast<int>(home.rooms.size());
    for (const Vector2d& p : outline.ring) room.polygon.outer.push_back(p + shift);
    room.floor_z = floor_z;
    room.ceiling_z = floor_z + random.Millimetres(2.3, 2.8);
    home.rooms.push_back(room);
  }
}

Vector3f FloorColour(Finish finish, Random& random) {
  static constexpr std::array<std::array<Vector3f::Scalar, 3>, 9> kColours = {
      {{0.42f, 0.37f, 0.31f},
       {0.33f, 0.33f, 0.33f},
       {0.50f, 0.46f, 0.40f},  // carpets
       {0.40f, 0.24f, 0.12f},
       {0.52f, 0.36f, 0.21f},
       {0.28f, 0.17f, 0.10f},  // planks
       {0.55f, 0.53f, 0.50f},
       {0.38f, 0.37f, 0.36f},
       {0.62f, 0.57f, 0.50f}}};  // tiles
  const int first = finish == Finish::kCarpet ? 0 : finish == Finish::kPlanks ? 3 : 6;
  const auto& c = kColours[static_cast<size_t>(first + random.Index(3))];
  return Vector3f(c[0], c[1], c[2]) * static_cast<float>(random.Uniform(0.9, 1.1));
}

// The largest room is lived in unless the layout says otherwise; paint and floors follow from the
// use.
void FitOutRooms(Home& home, const RoomLayout& layout, Random& random) {
  const auto largest = std::max_element(
      home.rooms.begin(), home.rooms.end(),
      [](const auto& a, const auto& b) { return Area(a.polygon) < Area(b.polygon); });
  const float grey = static_cast<float>(random.Uniform(0.74, 0.82));
  const Finish common = random.Chance(0.5) ? Finish::kPlanks : Finish::kCarpet;
  for (HomeRoom& room : home.rooms) {
    const bool is_largest = room.id == largest->id;
    room.use = is_largest            ? RoomUse::kLiving
               : random.Chance(0.35) ? RoomUse::kKitchen
                                     : RoomUse::kBedroom;
    if (home.rooms.size() == 1 && random.Chance(0.5)) room.use = RoomUse::kBedroom;
    room.use = layout.rooms[static_cast<size_t>(room.id)].use.value_or(room.use);
    room.floor_finish = room.use == RoomUse::kKitchen ? Finish::kTiles : common;
    room.floor_rgb = FloorColour(room.floor_finish, random);
    const float warmth = static_cast<float>(random.Uniform(0.0, 0.05));
    room.wall_rgb = grey * static_cast<float>(random.Uniform(0.96, 1.04)) *
                    Vector3f(1.0f, 1.0f - 0.4f * warmth, 1.0f - warmth);
  }
}

HomeSun RandomSun(Random& random) {
  const double azimuth = random.Uniform(-kPi, kPi);
  const double elevation = random.Uniform(DegToRad(20), DegToRad(50));
  HomeSun sun;
  sun.direction = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)};
  sun.irradiance *= static_cast<float>(random.Uniform(0.7, 1.2));
  return sun;
}

// Of the rooms to sleep or cook in, the smallest becomes the bath and the largest the kitchen.
void AssignWetRooms(Home& home) {
  std::vector<HomeRoom*> rooms;
  for (HomeRoom& room : home.rooms) {
    if (room.use == RoomUse::kBedroom || room.use == RoomUse::kKitchen) {
      room.use = RoomUse::kBedroom;
      rooms.push_back(&room);
    }
  }
  std::stable_sort(rooms.begin(), rooms.end(), [](const HomeRoom* a, const HomeRoom* b) {
    return Area(a->polygon) < Area(b->polygon);
  });
  const auto use = [](HomeRoom& room, RoomUse wet, Random& random) {
    room.use = wet;
    room.floor_finish = Finish::kTiles;
    room.floor_rgb = FloorColour(Finish::kTiles, random);
  };
  Random random(PartSeed(home.seed, static_cast<uint64_t>(SeedPart::kWetRooms)));
  if (!rooms.empty()) use(*rooms.front(), RoomUse::kBath, random);
  if (rooms.size() > 1) use(*rooms.back(), RoomUse::kKitchen, random);
}

// Gives one room a ceiling that rises along an axis, others a moulding under theirs or the colour
// of their walls.
void ShapeCeilings(Home& home, const HomeRecipe& recipe, Random& random) {
  for (HomeRoom& room : home.rooms) {
    if (random.Chance(recipe.crown_chance)) room.crown_m = random.Millimetres(0.05, 0.10);
    if (random.Chance(recipe.plain_ceilings)) room.ceiling_rgb = room.wall_rgb;
  }
  if (!random.Chance(recipe.slope_chance)) return;
  HomeRoom& room = random.Pick(home.rooms);
  if (room.use == RoomUse::kHall || room.use == RoomUse::kCloset) return;
  room.crown_m = 0;
  room.ceiling_z = room.floor_z + random.Millimetres(2.25, 2.4);
  const double rise = random.Uniform(0.15, 0.4) * (random.Chance(0.5) ? 1 : -1);
  room.ceiling_slope = random.Chance(0.5) ? Vector2d(rise, 0) : Vector2d(0, rise);
}

bool ShapeRooms(Home& home, const HomeRecipe& recipe, Random& random) {
  if (recipe.has_built_ins) AssignWetRooms(home);
  if (recipe.has_free_walls && !AddFreeWalls(home, random)) return false;
  if (recipe.has_curved_wall && !AddCurvedWall(home, random)) return false;
  if (recipe.num_niches > 0 && !AddNiches(home, recipe.num_niches, random)) return false;
  if (recipe.num_pillars > 0 && !AddPillars(home, recipe.num_pillars, random)) return false;
  if (recipe.slope_chance + recipe.crown_chance + recipe.plain_ceilings > 0)
    ShapeCeilings(home, recipe, random);
  return true;
}

bool CutOpenings(Home& home, const HomeRecipe& recipe, double max_thickness_m, Random& random) {
  for (int i = 0; i < recipe.num_wide_openings; ++i) {
    if (!AddWideOpening(home, max_thickness_m, random)) return false;
  }
  const bool has_doors = recipe.layout == LayoutKind::kBuilding
                             ? AddCorridorDoors(home, max_thickness_m, random)
                             : AddDoors(home, max_thickness_m, recipe.doors, random);
  if (!has_doors) return false;
  for (int i = 0; i < recipe.num_glass_walls; ++i) {
    if (!AddGlassWall(home, max_thickness_m, random)) return false;
  }
  if (!AddWindows(home, random)) return false;
  if (recipe.has_glass_door) GlazeADoor(home, random);
  return true;
}

bool FillRooms(Home& home, const HomeRecipe& recipe, double furniture, Random& random) {
  if (recipe.has_mirror_or_low_window && (random.Chance(0.5) || !HangMirror(home, random)))
    LowerAWindow(home, random);
  for (int i = 0; i < recipe.num_mirrors; ++i) {
    if (!HangMirror(home, random)) return false;
  }
  if (recipe.has_built_ins && !BuildIn(home, recipe.has_cabinets_to_ceiling, random)) return false;
  FurnishRooms(home, {recipe.furniture_share * furniture, recipe.furnished_rooms}, random);
  return true;
}

bool PlaceAllCameras(Home& home, const HomeRecipe& recipe, Random& random) {
  switch (recipe.cameras) {
    case CameraPlan::kRooms:
      return PlaceCameras(home, random);
    case CameraPlan::kTour:
      return PlaceTourCameras(home, random);
    case CameraPlan::kWalk:
      return PlaceWalkCameras(home, random);
    case CameraPlan::kBuilding:
      break;
  }
  return PlaceBuildingCameras(home, random);
}

std::optional<Home> TryMakeStorey(const HomeRecipe& recipe, const HomeOptions& options,
                                  uint64_t seed, Random& random) {
  Home home;
  home.seed = seed;
  const std::optional<RoomLayout> layout = MakeLayout(recipe, options.rooms, seed, random);
  if (!layout) return std::nullopt;
  AddRooms(home, *layout, random);
  FitOutRooms(home, *layout, random);
  if (!ShapeRooms(home, recipe, random)) return std::nullopt;
  if (!CutOpenings(home, recipe, layout->max_wall_thickness_m + 1e-6, random)) return std::nullopt;
  // Of many rooms one would always be too full for its camera: there furniture comes second.
  const bool is_building = recipe.layout == LayoutKind::kBuilding;
  if (is_building && !PlaceAllCameras(home, recipe, random)) return std::nullopt;
  if (!FillRooms(home, recipe, options.furniture, random)) return std::nullopt;
  if (!is_building && !PlaceAllCameras(home, recipe, random)) return std::nullopt;
  if (recipe.has_fittings) {
    Random own(PartSeed(home.seed, static_cast<uint64_t>(SeedPart::kFittings)));
    AddFittings(home, own);
  }
  if (recipe.min_hidden_floor_line > 0 &&
      !HideFloorLine(home, recipe.min_hidden_floor_line, random)) {
    return std::nullopt;
  }
  std::vector<float> radiance;
  for (const HomeRoom& room : home.rooms) {
    // About the same light on every floor, whatever its size.
    radiance.push_back(static_cast<float>(recipe.lamp_light * random.Uniform(0.8, 1.2) *
                                          (6 + Area(room.polygon))));
  }
  HangLamps(home, radiance);
  if (is_building) SpreadCorridorLamps(home);
  home.baseboard_m = random.Millimetres(0.05, 0.07);
  const double heading_rad =
      random.Uniform(DegToRad(3), DegToRad(42)) * (random.Chance(0.5) ? 1 : -1);
  home.home_from_world.rotation = RotationZ(-heading_rad);
  if (random.Chance(recipe.sun_chance)) home.sun = RandomSun(random);
  DisturbCameras(home, recipe, random);
  return home;
}

Home MakeStorey(const HomeRecipe& recipe, const HomeOptions& options, uint64_t seed) {
  constexpr uint64_t kAttempts = 200;
  for (uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    Random random(PartSeed(seed, attempt));
    const std::optional<Home> home = TryMakeStorey(recipe, options, seed, random);
    if (home && HomeProblems(*home).empty()) return *home;
  }
  ENFILADE_CHECK_MSG(false, "no valid home for seed " + std::to_string(options.seed));
}

Home MakeStoreys(HomeRecipe recipe, const HomeOptions& options) {
  const auto seed = static_cast<uint64_t>(options.seed);
  if (options.storeys == 1) return MakeStorey(recipe, options, seed);
  recipe.slope_chance = 0;  // a floor lies on every ceiling
  std::vector<Home> storeys = {MakeStorey(recipe, options, seed)};
  for (int i = 1; i < options.storeys; ++i) {
    const uint64_t part = static_cast<uint64_t>(SeedPart::kUpperStoreys) + static_cast<uint64_t>(i);
    storeys.push_back(MakeStorey(recipe, options, PartSeed(seed, part)));
  }
  Home home = StackStoreys(std::move(storeys));
  home.seed = seed;
  ENFILADE_CHECK(HomeProblems(home).empty());
  return home;
}

void CheckOptions(const HomeOptions& options, const HomeRecipe& recipe) {
  HomeOptions checked = options;
  ValidateOptions(VisitorOf(checked), "synthetic home");
  const int most_rooms = std::max(recipe.max_rooms, recipe.most_rooms);
  if (options.rooms != 0 && (options.rooms < recipe.min_rooms || options.rooms > most_rooms)) {
    throw InvalidInputError("rooms", "is " + std::to_string(options.rooms),
                            "homes of this preset have " + std::to_string(recipe.min_rooms) +
                                " to " + std::to_string(most_rooms));
  }
  if (options.storeys > recipe.max_storeys) {
    throw InvalidInputError("storeys", "is " + std::to_string(options.storeys),
                            "homes of this preset have one; give the preset flat or tour");
  }
}

}  // namespace

std::span<const std::string_view> EnumNames(HomePreset) {
  static constexpr std::array<std::string_view, 7> kNames = {"room", "flat", "tour",    "furnished",
                                                             "walk", "hard", "building"};
  return kNames;
}

int UsualWidth(HomePreset preset) {
  return preset == HomePreset::kTour || preset == HomePreset::kHard ? 2048 : 1024;
}

double HomeRoom::CeilingAt(const Vector2d& p) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector2d& corner : polygon.outer) lowest = std::min(lowest, ceiling_slope.dot(corner));
  return ceiling_z + ceiling_slope.dot(p) - lowest;
}

Ring2 HomeBox::Footprint() const {
  const Eigen::Rotation2Dd turn(yaw_rad);
  const Vector2d half = 0.5 * size;
  return {center - turn * half, center + turn * Vector2d(half.x(), -half.y()), center + turn * half,
          center + turn * Vector2d(-half.x(), half.y())};
}

int Home::NumStoreys() const {
  int highest = -1;
  for (const HomeRoom& room : rooms) highest = std::max(highest, room.storey_idx);
  return highest + 1;
}

bool Home::IsOnStorey(int room_id, int storey_idx) const {
  return RoomById(room_id).storey_idx == storey_idx;
}

const HomeRoom& Home::RoomById(int id) const {
  const auto it =
      std::find_if(rooms.begin(), rooms.end(), [&](const HomeRoom& room) { return room.id == id; });
  ENFILADE_CHECK(it != rooms.end());
  return *it;
}

int Home::StoreyOfCamera(int camera_idx) const {
  ENFILADE_CHECK(camera_idx >= 0 && camera_idx < static_cast<int>(cameras.size()));
  return RoomById(cameras[static_cast<size_t>(camera_idx)].room_id).storey_idx;
}

Rigid3 Home::WorldFromCamera(int camera_idx) const {
  ENFILADE_CHECK(camera_idx >= 0 && camera_idx < static_cast<int>(cameras.size()));
  return home_from_world.Inverse() * cameras[static_cast<size_t>(camera_idx)].home_from_cam;
}

Rigid3 Home::ClaimedWorldFromCamera(int camera_idx) const {
  ENFILADE_CHECK(camera_idx >= 0 && camera_idx < static_cast<int>(cameras.size()));
  const HomeCamera& camera = cameras[static_cast<size_t>(camera_idx)];
  return home_from_world.Inverse() * camera.claimed_home_from_cam.value_or(camera.home_from_cam);
}

Home MakeHome(const HomeOptions& options) {
  const HomeRecipe recipe = RecipeFor(options.preset);
  CheckOptions(options, recipe);
  Home home = MakeStoreys(recipe, options);
  if (options.tilt_deg > 0) {
    Random random(PartSeed(home.seed, static_cast<uint64_t>(SeedPart::kTilt)));
    TiltCameras(home, DegToRad(options.tilt_deg), random);
  }
  return home;
}

std::vector<HomeWall> HomeWalls(const Home& home) {
  std::vector<HomeWall> walls;
  for (const HomeRoom& room : home.rooms) {
    const std::vector<HomeWall> own = WallsOf(room, static_cast<int>(walls.size()));
    walls.insert(walls.end(), own.begin(), own.end());
  }
  return walls;
}

std::optional<std::pair<double, double>> OpeningOnWall(const HomeOpening& opening,
                                                       const HomeWall& wall) {
  constexpr double kTolerance_m = 1e-4;
  const bool is_own = opening.room_id == wall.room_id;
  if (!is_own && opening.other_room_id != wall.room_id) return std::nullopt;
  // On the other room's face the ends swap, so that its room is on the left again.
  const Vector2d through = opening.thickness_m * opening.IntoWall();
  const Vector2d from = is_own ? opening.a : opening.b + through;
  const Vector2d to = is_own ? opening.b : opening.a + through;
  const double begin_m = wall.Along().dot(from - wall.a), end_m = wall.Along().dot(to - wall.a);
  const bool is_on_face = std::abs(wall.Inward().dot(from - wall.a)) < kTolerance_m &&
                          std::abs(wall.Inward().dot(to - wall.a)) < kTolerance_m;
  const bool is_within =
      begin_m > -kTolerance_m && begin_m < end_m && end_m < (wall.b - wall.a).norm() + kTolerance_m;
  if (!is_on_face || !is_within) return std::nullopt;
  return std::pair(begin_m, end_m);
}

}  // namespace enfilade
