// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/furniture.h"

#include "src/synthetic/built_ins.h"
#include "src/synthetic/furniture_parts.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

void AddLegs(FurniturePiece& piece, Vector2d x, Vector2d y, double top_m, const Look& look) {
  constexpr double kLeg_m = 0.05;
  for (double left : {x[0], x[1] - kLeg_m}) {
    for (double back : {y[0], y[1] - kLeg_m}) {
      Add(piece, {left, left + kLeg_m}, {back, back + kLeg_m}, {0, top_m}, look);
    }
  }
}

FurniturePiece Wardrobe(Random& random) {
  const double w = random.Millimetres(1.0, 1.8), d = 0.6, h = random.Millimetres(1.9, 2.15);
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look look = Wood(random);
  Add(piece, {-w / 2, w / 2}, {0, d - 0.02}, {0, h}, look);
  const int num_doors = w > 1.3 ? 3 : 2;
  const double door_m = w / num_doors;
  for (int i = 0; i < num_doors; ++i) {
    const double left = -w / 2 + i * door_m;
    Add(piece, {left + 0.004, left + door_m - 0.004}, {d - 0.02, d}, {0.06, h - 0.01},
        1.05f * look);
    Add(piece, {left + 0.05, left + 0.065}, {d, d + 0.02}, {0.95, 1.15},
        {{0.3f, 0.3f, 0.3f}, Finish::kPlain});
  }
  return piece;
}

FurniturePiece Bed(Random& random) {
  const double w = random.Millimetres(0.95, 1.8), d = 2.05;
  FurniturePiece piece{{w, d}, true, false, {}};
  const Look wood = Wood(random), cover = Fabric(random);
  const Look linen{{0.75f, 0.74f, 0.72f}, Finish::kFabric};
  Add(piece, {-w / 2, w / 2}, {0, 0.05}, {0, random.Millimetres(0.85, 1.1)}, wood);
  Add(piece, {-w / 2, w / 2}, {0.05, d}, {0.08, 0.30}, wood);
  Add(piece, {-w / 2 + 0.03, w / 2 - 0.03}, {0.06, d - 0.03}, {0.30, 0.48}, linen);
  Add(piece, {-w / 2 + 0.01, w / 2 - 0.01}, {0.65, d - 0.01}, {0.36, 0.53}, cover);
  const int num_pillows = w > 1.3 ? 2 : 1;
  for (int i = 0; i < num_pillows; ++i) {
    const double middle = (i - 0.5 * (num_pillows - 1)) * w / 2;
    Add(piece, {middle - 0.3, middle + 0.3}, {0.10, 0.48}, {0.48, 0.60}, linen);
  }
  return piece;
}

FurniturePiece Drawers(Random& random) {
  const double w = random.Millimetres(0.45, 1.0), d = 0.42, h = random.Millimetres(0.5, 0.9);
  FurniturePiece piece{{w, d}, true, false, {}};
  const Look look = Wood(random);
  Add(piece, {-w / 2, w / 2}, {0, d - 0.02}, {0.04, h}, look);
  for (int i = 0; i < 3; ++i) {
    const double low = 0.06 + i * (h - 0.07) / 3;
    Add(piece, {-w / 2 + 0.01, w / 2 - 0.01}, {d - 0.02, d}, {low, low + (h - 0.07) / 3 - 0.012},
        1.06f * look);
  }
  return piece;
}

FurniturePiece Sofa(Random& random) {
  const double w = random.Millimetres(1.6, 2.2), d = 0.9, arm = 0.17;
  FurniturePiece piece{{w, d}, true, false, {}};
  const Look look = Fabric(random);
  Add(piece, {-w / 2, w / 2}, {0, d}, {0.06, 0.26}, look);
  Add(piece, {-w / 2, w / 2}, {0, 0.2}, {0.26, 0.82}, look);
  Add(piece, {-w / 2, -w / 2 + arm}, {0.2, d}, {0.26, 0.60}, look);
  Add(piece, {w / 2 - arm, w / 2}, {0.2, d}, {0.26, 0.60}, look);
  Add(piece, {-w / 2 + arm, -0.005}, {0.2, d + 0.02}, {0.26, 0.43}, 1.08f * look);
  Add(piece, {0.005, w / 2 - arm}, {0.2, d + 0.02}, {0.26, 0.43}, 1.08f * look);
  Add(piece, {-w / 2 + arm + 0.02, -w / 2 + arm + 0.42}, {0.2, 0.32}, {0.43, 0.78}, Fabric(random));
  return piece;
}

FurniturePiece Sideboard(Random& random) {
  const double w = random.Millimetres(1.2, 1.7), d = 0.42, h = random.Millimetres(0.45, 0.8);
  FurniturePiece piece{{w, d}, true, false, {}};
  const Look look = Wood(random);
  const Look screen{{0.02f, 0.02f, 0.022f}, Finish::kPlain};
  Add(piece, {-w / 2, w / 2}, {0, d}, {0.08, h}, look);
  AddLegs(piece, {-w / 2 + 0.05, w / 2 - 0.05}, {0.03, d - 0.03}, 0.08, 0.6f * look);
  Add(piece, {-0.12, 0.12}, {0.14, 0.28}, {h, h + 0.06}, screen);
  Add(piece, {-0.55, 0.55}, {0.19, 0.23}, {h + 0.06, h + 0.70}, screen);
  return piece;
}

FurniturePiece Bookshelf(Random& random) {
  const double w = random.Millimetres(0.7, 1.0), d = 0.3, h = random.Millimetres(1.6, 2.0),
               board = 0.02;
  FurniturePiece piece{{w, d}, true, true, {}};
  const Look look = Wood(random);
  Add(piece, {-w / 2, w / 2}, {0, 0.01}, {0, h}, 0.9f * look);
  Add(piece, {-w / 2, -w / 2 + board}, {0.01, d}, {0, h}, look);
  Add(piece, {w / 2 - board, w / 2}, {0.01, d}, {0, h}, look);
  const int num_shelves = 5;
  for (int i = 0; i <= num_shelves; ++i) {
    const double z = 0.04 + i * (h - 0.04 - board) / num_shelves;
    Add(piece, {-w / 2 + board, w / 2 - board}, {0.01, d}, {z, z + board}, look);
    if (i == num_shelves) break;
    for (double x = -w / 2 + board + 0.01; x < w / 2 - 0.12; x += 0.01) {
      const double thick = random.Uniform(0.03, 0.09);
      if (random.Chance(0.8)) {
        Add(piece, {x, x + thick}, {0.02, random.Uniform(0.16, 0.24)},
            {z + board, z + board + random.Uniform(0.17, 0.26)}, Fabric(random));
      }
      x += thick;
    }
  }
  return piece;
}

FurniturePiece DiningTable(Random& random) {
  const double w = random.Millimetres(1.1, 1.5), d = 0.8, h = 0.74;
  FurniturePiece piece{{w, d + 0.9}, false, false, {}};
  const Look look = Wood(random), seat = Wood(random);
  const double y0 = 0.45, y1 = y0 + d;
  Add(piece, {-w / 2, w / 2}, {y0, y1}, {h - 0.035, h}, look);
  AddLegs(piece, {-w / 2 + 0.04, w / 2 - 0.04}, {y0 + 0.04, y1 - 0.04}, h - 0.035, look);
  for (double middle : {-w / 4, w / 4}) {
    for (double front : {0.02, y1 + 0.03}) {
      const double back = front < y0 ? front : front + 0.37;
      Add(piece, {middle - 0.2, middle + 0.2}, {front, front + 0.4}, {0.43, 0.46}, seat);
      AddLegs(piece, {middle - 0.19, middle + 0.19}, {front + 0.01, front + 0.39}, 0.43, seat);
      Add(piece, {middle - 0.2, middle + 0.2}, {back, back + 0.03}, {0.46, 0.88}, seat);
    }
  }
  return piece;
}

}  // namespace

std::vector<FurniturePiece> FurnitureFor(RoomUse use, bool is_fitted, Random& random) {
  switch (use) {
    case RoomUse::kBedroom:
      return {Bed(random), Wardrobe(random), Drawers(random), Bookshelf(random)};
    case RoomUse::kKitchen:
      if (is_fitted) return {DiningTable(random), Sideboard(random)};
      return {KitchenRun({.width_m = random.Millimetres(1.8, 2.5)}, random), DiningTable(random),
              Sideboard(random)};
    case RoomUse::kBath:
      return {Drawers(random)};
    case RoomUse::kHall:
    case RoomUse::kCloset:
      return {};
    case RoomUse::kLiving:
      break;
  }
  return {Sofa(random), Sideboard(random), Bookshelf(random), DiningTable(random), Drawers(random)};
}

}  // namespace enfilade
