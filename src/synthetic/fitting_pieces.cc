// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/fitting_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/synthetic/furniture_parts.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

const Look kWhite{{0.82f, 0.82f, 0.80f}, Finish::kPlain};
const Look kSteel{{0.42f, 0.42f, 0.43f}, Finish::kPlain};
const Look kDark{{0.05f, 0.05f, 0.05f}, Finish::kPlain};

Look FrontLook(Random& random) { return random.Chance(0.5) ? 0.95f * kWhite : Wood(random); }

// Upright boards at both ends of [x0, x1] and every metre or less between.
void AddUprights(FurniturePiece& piece, Vector2d x, Vector2d y, Vector2d z, const Look& look) {
  constexpr double kBoard_m = 0.022, kMaxBay_m = 1.0;
  const int num_bays = static_cast<int>(std::ceil((x[1] - x[0]) / kMaxBay_m));
  for (int i = 0; i <= num_bays; ++i) {
    const double left = x[0] + (x[1] - x[0] - kBoard_m) * i / num_bays;
    Add(piece, {left, left + kBoard_m}, y, z, look);
  }
}

void AddHingedDoors(FurniturePiece& piece, double depth_m, Vector2d z, const Look& look) {
  constexpr double kThickness_m = 0.02, kGap_m = 0.003;
  const double w = piece.footprint.x();
  const int num_doors = 2 * std::max(1, static_cast<int>(std::lround(w / 1.0)));
  for (int i = 0; i < num_doors; ++i) {
    const double left = -w / 2 + i * w / num_doors, right = left + w / num_doors;
    Add(piece, {left + kGap_m, right - kGap_m}, {depth_m - kThickness_m, depth_m}, z, look);
    const double handle = i % 2 == 0 ? right - 0.05 : left + 0.035;
    const double middle = std::min(1.05, 0.5 * (z[0] + z[1]));
    Add(piece, {handle, handle + 0.015}, {depth_m, depth_m + 0.02}, {middle - 0.08, middle + 0.08},
        kSteel);
  }
}

// Two or three panels that run one before the other between a plinth and a rail.
void AddSlidingDoors(FurniturePiece& piece, double depth_m, double top_m, const Look& look) {
  const double w = piece.footprint.x();
  const int num_doors = w > 1.9 ? 3 : 2;
  Add(piece, {-w / 2, w / 2}, {depth_m - 0.07, depth_m}, {0, 0.03}, kSteel);
  Add(piece, {-w / 2, w / 2}, {depth_m - 0.07, depth_m}, {top_m - 0.06, top_m}, 0.95f * kWhite);
  for (int i = 0; i < num_doors; ++i) {
    const double left = -w / 2 + i * w / num_doors, right = left + w / num_doors;
    const double front = depth_m - (i % 2 == 0 ? 0.005 : 0.04);
    Add(piece, {std::max(-w / 2, left - 0.02), std::min(w / 2, right + 0.02)},
        {front - 0.02, front}, {0.03, top_m - 0.06}, look);
    Add(piece, {left + 0.05, left + 0.08}, {front, front + 0.002}, {0.95, 1.15}, kSteel);
  }
}

}  // namespace

FurniturePiece Radiator(double width_m, double top_m) {
  constexpr double kLow_m = 0.12, kPitch_m = 0.085;
  FurniturePiece piece{{width_m, 0.10}, true, false, {}};
  const double half = 0.5 * width_m;
  Add(piece, {-half, half}, {0.035, 0.088}, {kLow_m, top_m}, kWhite);
  for (double x = -half + 0.02; x + 0.055 < half; x += kPitch_m)
    Add(piece, {x, x + 0.055}, {0.088, 0.10}, {kLow_m + 0.03, top_m - 0.03}, kWhite);
  Add(piece, {half - 0.04, half - 0.02}, {0.05, 0.07}, {0, kLow_m}, kSteel);
  return piece;
}

FurniturePiece TowelRadiator() {
  constexpr double kHalf_m = 0.25, kLow_m = 0.6, kTop_m = 1.7;
  FurniturePiece piece{{2 * kHalf_m, 0.09}, true, true, {}};
  for (const double x : {-kHalf_m, kHalf_m - 0.035})
    Add(piece, {x, x + 0.035}, {0.04, 0.075}, {kLow_m, kTop_m}, kWhite);
  for (int i = 0; i < 14; ++i) {
    if (i % 5 == 4) continue;
    const double z = kLow_m + 0.03 + i * (kTop_m - kLow_m - 0.08) / 13;
    Add(piece, {-kHalf_m, kHalf_m}, {0.065, 0.09}, {z, z + 0.025}, kWhite);
  }
  return piece;
}

FurniturePiece Curtain(double width_m, double top_m, const Vector3f& rgb, Random& random) {
  FurniturePiece piece{{width_m, 0.13}, true, true, {}};
  bool is_in_front = random.Chance(0.5);
  for (double x = -0.5 * width_m; x < 0.5 * width_m - 0.01; is_in_front = !is_in_front) {
    const double next = std::min(x + random.Uniform(0.03, 0.06), 0.5 * width_m);
    const double back = is_in_front ? 0.075 : 0.05;
    Add(piece, {x, next}, {back, back + random.Uniform(0.035, 0.055)}, {0.015, top_m - 0.03},
        {static_cast<float>(random.Uniform(0.93, 1.04)) * rgb, Finish::kFabric});
    x = next;
  }
  return piece;
}

FurniturePiece CurtainRod(double width_m, double top_m) {
  FurniturePiece piece{{width_m, 0.10}, true, true, {}};
  const double half = 0.5 * width_m;
  Add(piece, {-half, half}, {0.08, 0.10}, {top_m - 0.022, top_m}, kSteel);
  for (const double x : {-half, half - 0.02})
    Add(piece, {x, x + 0.02}, {0, 0.08}, {top_m - 0.022, top_m}, kSteel);
  return piece;
}

FurniturePiece FittedWardrobe(double width_m, double top_m, Random& random) {
  constexpr double kDepth_m = 0.6;
  FurniturePiece piece{{width_m, kDepth_m}, true, true, {}};
  const Look front = FrontLook(random);
  if (random.Chance(0.5)) {
    Add(piece, {-width_m / 2, width_m / 2}, {0, kDepth_m - 0.07}, {0, top_m}, 0.9f * front);
    AddSlidingDoors(piece, kDepth_m, top_m, front);
  } else {
    Add(piece, {-width_m / 2, width_m / 2}, {0, kDepth_m - 0.02}, {0, top_m}, 0.9f * front);
    AddHingedDoors(piece, kDepth_m, {0.07, top_m - 0.04}, front);
  }
  return piece;
}

FurniturePiece TallCupboard(const Vector2d& footprint, double top_m, Random& random) {
  FurniturePiece piece{footprint, true, true, {}};
  const Look front = FrontLook(random);
  Add(piece, {-footprint.x() / 2, footprint.x() / 2}, {0, footprint.y() - 0.02}, {0, top_m},
      0.9f * front);
  AddHingedDoors(piece, footprint.y(), {0.07, top_m - 0.02}, front);
  return piece;
}

FurniturePiece ShowerCabin(Random& random) {
  constexpr double kTop_m = 2.0, kTray_m = 0.12, kFrame_m = 0.03;
  const double size_m = random.Millimetres(0.8, 0.95), half = 0.5 * size_m;
  FurniturePiece piece{{size_m, size_m}, true, true, {}};
  const Look pane{{0.60f, 0.66f, 0.66f}, Finish::kPlain};
  Add(piece, {-half, half}, {0, size_m}, {0, kTray_m}, kWhite);
  for (const double x : {-half, half - kFrame_m}) {
    Add(piece, {x, x + kFrame_m}, {size_m - kFrame_m, size_m}, {kTray_m, kTop_m}, kSteel);
    Add(piece, {x + 0.01, x + 0.018}, {0, size_m - kFrame_m}, {kTray_m, kTop_m - kFrame_m}, pane);
    Add(piece, {x, x + kFrame_m}, {0, size_m - kFrame_m}, {kTop_m - kFrame_m, kTop_m}, kSteel);
  }
  Add(piece, {-half + kFrame_m, half - kFrame_m}, {size_m - kFrame_m, size_m},
      {kTop_m - kFrame_m, kTop_m}, kSteel);
  Add(piece, {-half + kFrame_m, 0.02}, {size_m - 0.015, size_m - 0.007},
      {kTray_m, kTop_m - kFrame_m}, pane);
  Add(piece, {-0.02, half - kFrame_m}, {size_m - 0.025, size_m - 0.017},
      {kTray_m, kTop_m - kFrame_m}, pane);
  Add(piece, {0.03, 0.045}, {size_m - 0.007, size_m + 0.02}, {0.95, 1.25}, kSteel);
  return piece;
}

FurniturePiece FittedShelves(double width_m, double top_m, Random& random) {
  constexpr double kDepth_m = 0.32, kCupboard_m = 0.75, kCupboardDepth_m = 0.40, kBoard_m = 0.022;
  FurniturePiece piece{{width_m, kCupboardDepth_m}, true, true, {}};
  const Look look = FrontLook(random);
  const double half = 0.5 * width_m;
  Add(piece, {-half, half}, {0, kCupboardDepth_m - 0.02}, {0, kCupboard_m - 0.03}, look);
  AddHingedDoors(piece, kCupboardDepth_m, {0.07, kCupboard_m - 0.04}, look);
  Add(piece, {-half, half}, {0, kCupboardDepth_m}, {kCupboard_m - 0.03, kCupboard_m}, look);
  Add(piece, {-half, half}, {0, 0.01}, {kCupboard_m, top_m}, 0.92f * look);
  AddUprights(piece, {-half, half}, {0.01, kDepth_m}, {kCupboard_m, top_m}, look);
  constexpr int kNumShelves = 4;
  for (int i = 1; i <= kNumShelves; ++i) {
    const double z = kCupboard_m + (top_m - kCupboard_m) * i / kNumShelves - kBoard_m;
    Add(piece, {-half, half}, {0.01, kDepth_m - 0.005}, {z, z + kBoard_m}, look);
    const double left = random.Uniform(-half + 0.1, half - 0.35);
    if (i < kNumShelves && random.Chance(0.5))
      Add(piece, {left, left + random.Uniform(0.08, 0.25)}, {0.05, random.Uniform(0.18, 0.28)},
          {z + kBoard_m, z + random.Uniform(0.15, 0.28)}, Fabric(random));
  }
  return piece;
}

FurniturePiece Bulkhead(const Vector2d& footprint, double low_m, double top_m,
                        const Vector3f& rgb) {
  FurniturePiece piece{footprint, true, true, {}};
  Add(piece, {-0.5 * footprint.x(), 0.5 * footprint.x()}, {0, footprint.y()}, {low_m, top_m},
      {rgb, Finish::kPaint});
  return piece;
}

FurniturePiece MovingBoxes(Random& random) {
  constexpr double kPitch_m = 0.52, kHeight_m = 0.36;
  const int num_stacks = 1 + random.Index(3);
  FurniturePiece piece{{num_stacks * kPitch_m, 0.50}, true, false, {}};
  for (int i = 0; i < num_stacks; ++i) {
    const double middle = (i + 0.5 - 0.5 * num_stacks) * kPitch_m;
    const int height = 1 + random.Index(3);
    for (int k = 0; k < height; ++k) {
      const double half = 0.5 * random.Uniform(0.40, 0.50), z = k * kHeight_m;
      const double back = random.Uniform(0.03, 0.07), front = back + random.Uniform(0.34, 0.42);
      const Look card{Vector3f(0.42f, 0.30f, 0.19f) * static_cast<float>(random.Uniform(0.85, 1.1)),
                      Finish::kPlain};
      Add(piece, {middle - half, middle + half}, {back, front}, {z, z + kHeight_m - 0.002}, card);
      Add(piece, {middle - 0.03, middle + 0.03}, {front, front + 0.002},
          {z + kHeight_m - 0.12, z + kHeight_m - 0.002}, 1.35f * card);
    }
  }
  return piece;
}

FurniturePiece WallShelf(Random& random) {
  const double w = random.Millimetres(0.6, 1.2), d = 0.22, z = random.Millimetres(1.25, 1.7);
  FurniturePiece piece{{w, d}, true, true, {}};
  Add(piece, {-w / 2, w / 2}, {0, d}, {z, z + 0.025}, FrontLook(random));
  for (const double x : {-w / 2 + 0.1, w / 2 - 0.12})
    Add(piece, {x, x + 0.02}, {0, 0.16}, {z - 0.03, z}, kSteel);
  double x = -w / 2 + 0.04;
  while (x < w / 2 - 0.2) {
    const double thick = random.Uniform(0.04, 0.14);
    if (random.Chance(0.5))
      Add(piece, {x, x + thick}, {0.03, random.Uniform(0.12, 0.18)},
          {z + 0.025, z + random.Uniform(0.12, 0.27)}, Fabric(random));
    x += thick + random.Uniform(0.005, 0.1);
  }
  return piece;
}

FurniturePiece Picture(Random& random) {
  const double w = random.Millimetres(0.35, 0.95), h = random.Millimetres(0.4, 0.8);
  const double low = 1.5 - 0.5 * h, rim = 0.025, mat = random.Chance(0.5) ? 0.06 : 0.005;
  FurniturePiece piece{{w, 0.025}, true, true, {}};
  const Look frame = random.Chance(0.3) ? kDark : random.Chance(0.4) ? kWhite : Wood(random);
  Add(piece, {-w / 2, w / 2}, {0, 0.015}, {low, low + h}, kWhite);
  for (const double x : {-w / 2, w / 2 - rim})
    Add(piece, {x, x + rim}, {0.015, 0.025}, {low, low + h}, frame);
  for (const double z : {low, low + h - rim})
    Add(piece, {-w / 2 + rim, w / 2 - rim}, {0.015, 0.025}, {z, z + rim}, frame);
  const Vector2d x(-w / 2 + rim + mat, w / 2 - rim - mat);
  const Vector2d z(low + rim + mat, low + h - rim - mat);
  Add(piece, x, {0.015, 0.017}, z, Fabric(random));
  // A motif of a few plain areas.
  for (int i = 0; i < 4; ++i) {
    const double x0 = random.Uniform(x[0], x[1] - 0.08), z0 = random.Uniform(z[0], z[1] - 0.08);
    Add(piece, {x0, random.Uniform(x0 + 0.05, x[1])}, {0.017, 0.018 + 0.0005 * i},
        {z0, random.Uniform(z0 + 0.05, z[1])}, random.Chance(0.5) ? Fabric(random) : Wood(random));
  }
  return piece;
}

FurniturePiece PaintPatch(const HomeRoom& room, Random& random) {
  const double w = random.Millimetres(0.3, 0.9), h = random.Millimetres(0.3, 0.8);
  const double low = 1.5 - 0.5 * h;
  const double change = random.Uniform(0.03, 0.06) * (random.Chance(0.7) ? 1 : -1);
  FurniturePiece piece{{w, 0.002}, true, true, {}};
  Add(piece, {-w / 2, w / 2}, {0, 0.002}, {low, low + h},
      {static_cast<float>(1 + change) * room.wall_rgb, room.wall_finish});
  return piece;
}

FurniturePiece Socket() {
  FurniturePiece piece{{0.075, 0.012}, true, false, {}};
  Add(piece, {-0.0375, 0.0375}, {0, 0.008}, {0.28, 0.395}, kWhite);
  for (const double z : {0.295, 0.345})
    Add(piece, {-0.018, 0.018}, {0.008, 0.010}, {z, z + 0.035}, 0.45f * kWhite);
  return piece;
}

// The plate is a rim about the rocker: the light of a small face is asked for at its middle, which
// nothing may cover. So with the thermostat and its display.
FurniturePiece LightSwitch() {
  constexpr double kRocker_m = 0.017, kLow_m = 1.085, kHigh_m = 1.155;
  FurniturePiece piece{{0.08, 0.016}, true, false, {}};
  Add(piece, {-0.04, -kRocker_m}, {0, 0.008}, {1.06, 1.18}, kWhite);
  Add(piece, {kRocker_m, 0.04}, {0, 0.008}, {1.06, 1.18}, kWhite);
  Add(piece, {-kRocker_m, kRocker_m}, {0, 0.008}, {1.06, kLow_m}, kWhite);
  Add(piece, {-kRocker_m, kRocker_m}, {0, 0.008}, {kHigh_m, 1.18}, kWhite);
  Add(piece, {-kRocker_m, kRocker_m}, {0, 0.016}, {kLow_m, kHigh_m}, 0.9f * kWhite);
  return piece;
}

FurniturePiece Thermostat() {
  FurniturePiece piece{{0.13, 0.028}, true, false, {}};
  Add(piece, {-0.065, 0.065}, {0, 0.025}, {1.44, 1.54}, kWhite);
  Add(piece, {-0.035, 0.035}, {0.025, 0.028}, {1.495, 1.53}, 0.3f * kWhite);
  return piece;
}

FurniturePiece Grille(const Vector2d& size, double low_m) {
  constexpr double kRim_m = 0.025, kPitch_m = 0.025;
  FurniturePiece piece{{size.x(), 0.015}, true, false, {}};
  const double half = 0.5 * size.x(), top = low_m + size.y();
  Add(piece, {-half, half}, {0, 0.004}, {low_m, top}, 0.25f * kWhite);
  for (const double x : {-half, half - kRim_m})
    Add(piece, {x, x + kRim_m}, {0.004, 0.015}, {low_m, top}, kWhite);
  for (double z = low_m; z + 0.014 <= top + 1e-9; z += kPitch_m)
    Add(piece, {-half + kRim_m, half - kRim_m}, {0.004, 0.013}, {z, z + 0.014}, kWhite);
  return piece;
}

}  // namespace enfilade
