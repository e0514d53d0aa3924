// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/built_ins.h"

#include <algorithm>

#include "src/synthetic/furniture_parts.h"

namespace enfilade {
namespace {

const Look kEnamel{{0.80f, 0.80f, 0.79f}, Finish::kPlain};
const Look kSteel{{0.42f, 0.42f, 0.43f}, Finish::kPlain};
const Look kGlassMirror{{0.03f, 0.03f, 0.03f}, Finish::kMirror};

Look FrontLook(Random& random) {
  return random.Chance(0.6) ? Look{{0.70f, 0.70f, 0.68f}, Finish::kPlain} : Wood(random);
}

FurniturePiece Fridge(Random& random) {
  const double w = random.Millimetres(0.6, 0.9), d = 0.68, h = random.Millimetres(1.6, 1.85);
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look look = random.Chance(0.5) ? kEnamel : kSteel;
  Add(piece, {-w / 2, w / 2}, {0, d - 0.06}, {0.03, h}, look);
  Add(piece, {-w / 2, w / 2}, {d - 0.055, d}, {0.06, 0.55}, 1.05f * look);
  Add(piece, {-w / 2, w / 2}, {d - 0.055, d}, {0.56, h}, 1.05f * look);
  return piece;
}

// A tub with its apron and, at times, a curtain before half of it.
FurniturePiece Tub(Random& random) {
  const double w = random.Millimetres(1.5, 1.75), d = 0.76, h = 0.52, rim = 0.08;
  FurniturePiece piece{{w, d}, true, true, {}};
  Add(piece, {-w / 2, w / 2}, {0, rim}, {0, h}, kEnamel);
  Add(piece, {-w / 2, w / 2}, {d - rim, d}, {0, h}, kEnamel);
  Add(piece, {-w / 2, -w / 2 + rim}, {rim, d - rim}, {0, h}, kEnamel);
  Add(piece, {w / 2 - rim, w / 2}, {rim, d - rim}, {0, h}, kEnamel);
  Add(piece, {-w / 2 + rim, w / 2 - rim}, {rim, d - rim}, {0, 0.16}, kEnamel);
  if (random.Chance(0.6)) {
    const double side = random.Chance(0.5) ? -w / 2 : 0.05;
    Add(piece, {side, side + w / 2 - 0.05}, {d - rim + 0.01, d - rim + 0.03}, {0.3, 1.95},
        Fabric(random));
  }
  return piece;
}

FurniturePiece Basin(Random& random) {
  const double w = random.Millimetres(0.7, 1.3), d = 0.5, h = 0.82;
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look front = FrontLook(random);
  Add(piece, {-w / 2, w / 2}, {0, d - 0.05}, {0, 0.1}, 0.2f * front);
  Add(piece, {-w / 2, w / 2}, {0, d - 0.02}, {0.1, h}, front);
  Add(piece, {-w / 2, w / 2}, {0, d}, {h, h + 0.04}, kEnamel);
  Add(piece, {-0.03, 0.03}, {0.06, 0.18}, {h + 0.04, h + 0.2}, kSteel);
  Add(piece, {-w / 2 + 0.04, w / 2 - 0.04}, {0, 0.02}, {1.0, 1.9}, kGlassMirror);
  return piece;
}

FurniturePiece Toilet() {
  FurniturePiece piece{{0.4, 0.68}, true, false, {}};
  Add(piece, {-0.2, 0.2}, {0, 0.18}, {0.36, 0.78}, kEnamel);
  Add(piece, {-0.12, 0.12}, {0.1, 0.55}, {0, 0.36}, kEnamel);
  Add(piece, {-0.19, 0.19}, {0.18, 0.68}, {0.36, 0.43}, kEnamel);
  return piece;
}

FurniturePiece ClosetShelf(Random& random) {
  const double w = random.Millimetres(0.8, 1.2), d = 0.32;
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look look = FrontLook(random);
  Add(piece, {-w / 2, w / 2}, {0, d}, {1.68, 1.70}, look);
  Add(piece, {-w / 2, w / 2}, {0.24, 0.27}, {1.60, 1.63}, kSteel);
  return piece;
}

// Doors of cabinets from the floor to the ceiling: one takes them for the wall.
FurniturePiece CabinetsToCeiling(double height_m, Random& random) {
  const double w = random.Millimetres(1.0, 2.2), d = random.Millimetres(0.35, 0.6);
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look front = FrontLook(random);
  const int num_doors = std::max(2, static_cast<int>(w / 0.5));
  Add(piece, {-w / 2, w / 2}, {0, d - 0.02}, {0, height_m}, front);
  for (int i = 0; i < num_doors; ++i) {
    const double left = -w / 2 + i * w / num_doors;
    Add(piece, {left + 0.003, left + w / num_doors - 0.003}, {d - 0.02, d}, {0.06, height_m - 0.06},
        1.03f * front);
  }
  return piece;
}

}  // namespace

FurniturePiece KitchenRun(const KitchenRunSize& size, Random& random) {
  const double w = size.width_m, d = 0.62, top = size.wall_cabinets_top_m;
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look front = FrontLook(random);
  const int num_units = static_cast<int>(w / 0.55);
  Add(piece, {-w / 2, w / 2}, {0, d - 0.08}, {0, 0.1}, {{0.08f, 0.08f, 0.08f}, Finish::kPlain});
  Add(piece, {-w / 2, w / 2}, {0, d - 0.04}, {0.1, 0.87}, 0.5f * front);
  Add(piece, {-w / 2, w / 2}, {0, 0.33}, {1.42, top}, 0.5f * front);
  for (int i = 0; i < num_units; ++i) {
    const double left = -w / 2 + i * w / num_units, right = left + w / num_units;
    Add(piece, {left + 0.003, right - 0.003}, {d - 0.04, d - 0.02}, {0.105, 0.865}, front);
    Add(piece, {left + 0.003, right - 0.003}, {0.33, 0.35}, {1.42, top}, front);
  }
  Add(piece, {-w / 2, w / 2}, {0, d}, {0.87, 0.91}, Wood(random));
  if (size.soffit_top_m > top) {
    Add(piece, {-w / 2, w / 2}, {0, 0.37}, {top, size.soffit_top_m},
        {{0.78f, 0.78f, 0.76f}, Finish::kPaint});
  }
  return piece;
}

std::vector<FurniturePiece> BuiltInsFor(const HomeRoom& room, bool has_cabinets_to_ceiling,
                                        Random& random) {
  const double height_m = room.ceiling_z - room.floor_z;
  std::vector<FurniturePiece> pieces;
  if (room.use == RoomUse::kKitchen) {
    const double soffit_m = random.Chance(0.6) ? height_m : 0;
    for (const double narrowest_m : {2.2, 1.4}) {
      pieces.push_back(KitchenRun({.width_m = random.Millimetres(narrowest_m, narrowest_m + 1.0),
                                   .wall_cabinets_top_m = 2.1,
                                   .soffit_top_m = soffit_m},
                                  random));
    }
    pieces.push_back(Fridge(random));
  } else if (room.use == RoomUse::kBath) {
    pieces = {Tub(random), Basin(random), Toilet()};
  } else if (room.use == RoomUse::kCloset) {
    pieces = {ClosetShelf(random)};
  } else if (has_cabinets_to_ceiling && room.use != RoomUse::kHall) {
    pieces = {CabinetsToCeiling(height_m, random)};
  }
  return pieces;
}

}  // namespace enfilade
