// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/fittings.h"

#include <algorithm>
#include <cmath>

#include "src/synthetic/fitting_pieces.h"
#include "src/synthetic/furniture_parts.h"
#include "src/synthetic/outline.h"
#include "src/synthetic/wall_fitter.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr double kRadiatorHomes = 0.4;
constexpr double kToCeiling = 0.9;  // of what stands up to 2 m or higher
constexpr double kCurtainWindows = 0.42;
constexpr double kDrawnCurtains = 0.25;  // of these
constexpr double kBulkheadRooms = 0.25;
constexpr double kBoxRooms = 0.08;       // of the rooms without furniture
constexpr double kLowBulkhead_m = 2.12;  // passes above door frames

// One room and what there is in it already.
struct RoomToFit {
  Home& home;
  const HomeRoom& room;
  WallFitter walls;
  bool is_furnished = false;

  [[nodiscard]] double Height() const { return room.ceiling_z - room.floor_z; }
};

bool IsFurnished(const Home& home, const HomeRoom& room) {
  return std::any_of(home.boxes.begin(), home.boxes.end(), [&](const HomeBox& box) {
    return box.room_id == room.id && !box.is_built_in && box.finish != Finish::kMirror;
  });
}

double TopOf(const RoomToFit& fit, Random& random) {
  return random.Chance(kToCeiling) ? fit.Height() : random.Millimetres(2.0, 2.15);
}

// What of the cupboards of one kind a room gets: the widest that there is a place for.
struct CupboardRow {
  FurniturePiece (*make)(double width_m, double top_m, Random&);
  double chance = 1;
  double widest_m = 3;
};

FurniturePiece CoatCupboard(double width_m, double top_m, Random& random) {
  return TallCupboard({width_m, 0.38}, top_m, random);
}

FurniturePiece Larder(double width_m, double top_m, Random& random) {
  return TallCupboard({width_m, 0.6}, top_m, random);
}

std::vector<CupboardRow> CupboardsFor(RoomUse use) {
  switch (use) {
    case RoomUse::kBedroom:
      return {{FittedWardrobe, 0.8, 2.4}};
    case RoomUse::kLiving:
      return {{FittedShelves, 0.7, 2.1}, {CoatCupboard, 0.2, 1.4}};
    case RoomUse::kKitchen:
      return {{Larder, 0.5, 1.2}};
    case RoomUse::kBath:
      return {{CoatCupboard, 0.3, 0.8}};
    case RoomUse::kHall:
      return {{CoatCupboard, 0.4, 1.2}};
    case RoomUse::kCloset:
      break;
  }
  return {};
}

void FitCupboards(RoomToFit& fit, Random& random) {
  if (fit.room.use == RoomUse::kBath && random.Chance(0.35))
    (void)fit.walls.FixSomewhere(ShowerCabin(random), random);
  for (const CupboardRow& row : CupboardsFor(fit.room.use)) {
    if (!random.Chance(row.chance)) continue;
    for (const double share : {1.0, 0.75, 0.5}) {
      const double width_m = share * random.Millimetres(0.75 * row.widest_m, row.widest_m);
      if (fit.walls.FixSomewhere(row.make(width_m, TopOf(fit, random), random), random)) break;
    }
  }
}

// Along a whole wall; the lamp, in the middle of the room, stays clear of it.
void FitBulkhead(RoomToFit& fit, Random& random) {
  constexpr int kTries = 12;
  if (fit.room.use == RoomUse::kHall || !fit.room.HasLevelCeiling()) return;
  if (!random.Chance(kBulkheadRooms)) return;
  const double narrow_m = BoundsOf(fit.room.polygon.outer).Size().minCoeff();
  const double depth_m = std::min(random.Millimetres(0.3, 0.6), 0.2 * narrow_m);
  const double low_m = std::max(fit.Height() - random.Millimetres(0.2, 0.4), kLowBulkhead_m);
  const Vector3f rgb = random.Chance(0.5) ? fit.room.wall_rgb : fit.room.ceiling_rgb;
  for (int tries = 0; tries < kTries; ++tries) {
    const HomeWall& wall = random.Pick(fit.walls.walls());
    const double length_m = (wall.b - wall.a).norm();
    if (length_m < 1.5) continue;
    const FurniturePiece piece = Bulkhead({length_m, depth_m}, low_m, fit.Height(), rgb);
    if (fit.walls.FixAt(wall, 0.5 * length_m, piece)) return;
  }
}

struct WindowPlace {
  HomeWall wall;
  double begin_m = 0, end_m = 0;
  double sill_m = 0, head_m = 0;  ///< above the floor
};

std::vector<WindowPlace> WindowsOf(const RoomToFit& fit) {
  std::vector<WindowPlace> windows;
  for (const HomeOpening& opening : fit.home.openings) {
    if (opening.kind != OpeningKind::kWindow || opening.other_room_id) continue;
    for (const HomeWall& wall : fit.walls.walls()) {
      const auto on = OpeningOnWall(opening, wall);
      if (on)
        windows.push_back({wall, on->first, on->second, opening.sill_z - fit.room.floor_z,
                           opening.head_z - fit.room.floor_z});
    }
  }
  return windows;
}

void HangCurtains(RoomToFit& fit, const WindowPlace& window, Random& random) {
  const double rod_m = window.head_m + random.Millimetres(0.08, 0.2), rail_m = fit.Height() - 0.01;
  const double top_m = random.Chance(0.5) ? rail_m : std::min(rod_m, rail_m);
  const double side_m = random.Millimetres(0.28, 0.5);
  const double drawn_m = random.Chance(kDrawnCurtains)
                             ? random.Uniform(0.3, 0.46) * (window.end_m - window.begin_m)
                             : 0;
  const Look light{{0.66f, 0.63f, 0.57f}, Finish::kFabric};
  const Vector3f rgb = (random.Chance(0.5) ? light : Fabric(random)).rgb;
  const FurniturePiece left = Curtain(side_m + drawn_m, top_m, rgb, random);
  const FurniturePiece right = Curtain(side_m + drawn_m, top_m, rgb, random);
  constexpr auto kAllowed = BeforeWindows::kAllowed;
  const bool has_left =
      fit.walls.FixAt(window.wall, window.begin_m + 0.5 * (drawn_m - side_m), left, kAllowed);
  const bool has_right =
      fit.walls.FixAt(window.wall, window.end_m - 0.5 * (drawn_m - side_m), right, kAllowed);
  if (!has_left && !has_right) return;
  const FurniturePiece rod = CurtainRod(window.end_m - window.begin_m + 0.2, top_m);
  (void)fit.walls.FixAt(window.wall, 0.5 * (window.begin_m + window.end_m), rod, kAllowed);
}

void FitWindows(RoomToFit& fit, bool has_radiators, Random& random) {
  const bool has_curtains = fit.room.use == RoomUse::kLiving || fit.room.use == RoomUse::kBedroom;
  for (const WindowPlace& window : WindowsOf(fit)) {
    const double width_m = window.end_m - window.begin_m, middle_m = window.begin_m + 0.5 * width_m;
    const double top_m = std::min(window.sill_m - 0.08, random.Millimetres(0.6, 0.75));
    if (has_radiators && top_m > 0.35)
      (void)fit.walls.FixAt(window.wall, middle_m,
                            Radiator(random.Uniform(0.5, 0.85) * width_m, top_m));
    if (has_curtains && random.Chance(kCurtainWindows)) HangCurtains(fit, window, random);
  }
}

void FitLooseThings(RoomToFit& fit, Random& random) {
  const RoomUse use = fit.room.use;
  if (use == RoomUse::kHall) return;
  if (use == RoomUse::kBath) {
    if (random.Chance(0.5)) (void)fit.walls.FixSomewhere(TowelRadiator(), random);
    return;
  }
  if (!fit.is_furnished && random.Chance(kBoxRooms))
    (void)fit.walls.FixSomewhere(MovingBoxes(random), random);
  if (random.Chance(0.3)) (void)fit.walls.FixSomewhere(WallShelf(random), random);
}

void FitSwitches(RoomToFit& fit, Random& random) {
  constexpr double kFromFrame_m = 0.2;
  for (const HomeOpening& opening : fit.home.openings) {
    if (opening.kind == OpeningKind::kWindow) continue;
    for (const HomeWall& wall : fit.walls.walls()) {
      const auto on = OpeningOnWall(opening, wall);
      if (!on) continue;
      // Where the handle is, on the side that the door opens to.
      const bool is_after =
          opening.room_id == fit.room.id ? opening.is_hinge_at_a : random.Chance(0.5);
      const double middle_m = is_after ? on->second + kFromFrame_m : on->first - kFromFrame_m;
      (void)fit.walls.FixAt(wall, middle_m, LightSwitch());
    }
  }
}

void FitSockets(RoomToFit& fit, Random& random) {
  constexpr double kEvery_m = 2.2, kFromCorner_m = 0.15;
  for (const HomeWall& wall : fit.walls.walls()) {
    const double length_m = (wall.b - wall.a).norm();
    const int count = static_cast<int>(std::lround(length_m / kEvery_m));
    for (int i = 0; i < count; ++i) {
      const double middle_m = random.Millimetres(kFromCorner_m, length_m - kFromCorner_m);
      (void)fit.walls.FixAt(wall, middle_m, Socket());
    }
  }
}

void FitPictures(RoomToFit& fit, Random& random) {
  const int count = 2 + random.Index(3);
  for (int i = 0; i < count; ++i) {
    const bool is_left = fit.is_furnished || random.Chance(0.4);
    const FurniturePiece piece = is_left ? Picture(random) : PaintPatch(fit.room, random);
    (void)fit.walls.FixSomewhere(piece, random);
  }
}

void FitPlates(RoomToFit& fit, bool has_radiators, Random& random) {
  FitSwitches(fit, random);
  FitSockets(fit, random);
  const bool is_hall = fit.room.use == RoomUse::kHall;
  if (is_hall) (void)fit.walls.FixSomewhere(Thermostat(), random);
  if (is_hall && !has_radiators)
    (void)fit.walls.FixSomewhere(Grille({0.6, 0.4}, fit.Height() - 0.6), random);
  if (!is_hall && !has_radiators)
    (void)fit.walls.FixSomewhere(Grille({0.35, 0.2}, random.Chance(0.5) ? 0.12 : 2.0), random);
  FitPictures(fit, random);
}

}  // namespace

void AddFittings(Home& home, Random& random) {
  const bool has_radiators = random.Chance(kRadiatorHomes);
  for (HomeRoom& room : home.rooms) {
    room.wall_finish = Finish::kOrangePeel;
    if (room.use == RoomUse::kCloset) continue;
    RoomToFit fit{home, room, WallFitter(home, room), IsFurnished(home, room)};
    FitCupboards(fit, random);
    FitWindows(fit, has_radiators, random);
    FitBulkhead(fit, random);
    FitLooseThings(fit, random);
    FitPlates(fit, has_radiators, random);
  }
}

}  // namespace enfilade
