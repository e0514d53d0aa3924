// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "src/synthetic/placement.h"
#include "src/synthetic/random.h"
#include "src/synthetic/surface.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr double kBaseboardDepth_m = 0.012;
constexpr double kCasingWidth_m = 0.065;
constexpr double kCasingDepth_m = 0.014;

// A box against a wall face: [u0, u1] along it from wall.a, [d0, d1] into the room.
HomeBox BoxOnWall(const HomeWall& wall, double u0, double u1, double d0, double d1, double z0,
                  double z1) {
  HomeBox box;
  box.room_id = wall.room_id;
  box.center = wall.a + 0.5 * (u0 + u1) * wall.Along() + 0.5 * (d0 + d1) * wall.Inward();
  box.size = {u1 - u0, d1 - d0};
  box.yaw_rad = std::atan2(wall.Along().y(), wall.Along().x());
  box.z0 = z0;
  box.z1 = z1;
  return box;
}

SurfaceTraits WallTraits(const HomeWall& wall, const Vector3f& rgb) {
  SurfaceTraits traits;
  traits.rgb = rgb;
  traits.label = SurfaceLabel::kWall;
  traits.room_id = wall.room_id;
  traits.wall_id = wall.id;
  return traits;
}

// Baseboards are white lacquer, grey or wood; door frames and leaves match them or are white.
struct TrimColours {
  SurfaceTraits baseboard, frame;
};

TrimColours PickTrimColours(const Home& home) {
  constexpr std::array<std::array<float, 3>, 4> kBaseboards = {
      {{0.86f, 0.86f, 0.85f}, {0.86f, 0.86f, 0.85f}, {0.45f, 0.44f, 0.42f}, {0.40f, 0.26f, 0.15f}}};
  Random random(PartSeed(home.seed, 77));
  const int pick = random.Index(4);
  TrimColours colours;
  colours.baseboard.rgb = Vector3f(kBaseboards[static_cast<size_t>(pick)].data());
  colours.baseboard.finish = pick == 3 ? Finish::kWood : Finish::kPlain;
  colours.frame = colours.baseboard;
  if (pick != 3 || random.Chance(0.5)) {
    colours.frame.rgb = {0.80f, 0.80f, 0.78f};
    colours.frame.finish = Finish::kPlain;
  }
  return colours;
}

void AddBaseboards(const Home& home, const HomeWall& wall, const SurfaceTraits& look,
                   SurfaceList& list) {
  if (home.baseboard_m <= 0) return;
  const double floor_z = home.RoomById(wall.room_id).floor_z;
  std::vector<std::pair<double, double>> gaps;
  for (const HomeOpening& opening : home.openings) {
    const auto on = OpeningOnWall(opening, wall);
    if (!on || opening.kind == OpeningKind::kWindow) continue;
    const double margin_m = opening.kind == OpeningKind::kDoor ? kCasingWidth_m : 0;
    gaps.emplace_back(on->first - margin_m, on->second + margin_m);
  }
  const double length_m = (wall.b - wall.a).norm();
  gaps.emplace_back(length_m, length_m);
  std::sort(gaps.begin(), gaps.end());
  SurfaceTraits traits = look;
  traits.label = SurfaceLabel::kWall;
  traits.room_id = wall.room_id;
  traits.wall_id = wall.id;
  double begin_m = 0;
  for (const auto& [from_m, to_m] : gaps) {
    if (from_m - begin_m > 1e-3) {
      list.AddBox(BoxOnWall(wall, begin_m, from_m, 0, kBaseboardDepth_m, floor_z,
                            floor_z + home.baseboard_m),
                  traits);
    }
    begin_m = to_m;
  }
}

// A moulding in the angle of wall and ceiling.
void AddCrown(const Home& home, const HomeWall& wall, SurfaceList& list) {
  const HomeRoom& room = home.RoomById(wall.room_id);
  if (room.crown_m <= 0) return;
  const SurfaceTraits traits = WallTraits(wall, room.ceiling_rgb);
  list.AddBox(BoxOnWall(wall, 0, (wall.b - wall.a).norm(), 0, 0.6 * room.crown_m,
                        room.ceiling_z - room.crown_m, room.ceiling_z),
              traits);
}

// Frame round a door on one face of its wall.
void AddCasing(const HomeOpening& door, const HomeWall& wall, std::pair<double, double> on,
               const SurfaceTraits& look, SurfaceList& list) {
  SurfaceTraits traits = look;
  traits.label = SurfaceLabel::kWall;
  traits.room_id = wall.room_id;
  traits.wall_id = wall.id;
  const double top_z = door.head_z + kCasingWidth_m;
  const auto [u0, u1] = on;
  list.AddBox(BoxOnWall(wall, u0 - kCasingWidth_m, u0, 0, kCasingDepth_m, door.sill_z, top_z),
              traits);
  list.AddBox(BoxOnWall(wall, u1, u1 + kCasingWidth_m, 0, kCasingDepth_m, door.sill_z, top_z),
              traits);
  list.AddBox(BoxOnWall(wall, u0, u1, 0, kCasingDepth_m, door.head_z, top_z), traits);
}

void AddHandles(const HomeBox& leaf, bool is_hinge_at_start, SurfaceList& list) {
  SurfaceTraits traits;
  traits.rgb = {0.35f, 0.35f, 0.36f};
  traits.room_id = leaf.room_id;
  const Vector2d along(std::cos(leaf.yaw_rad), std::sin(leaf.yaw_rad));
  HomeBox handle = leaf;
  handle.center += (is_hinge_at_start ? 1 : -1) * (0.5 * leaf.size.x() - 0.10) * along;
  handle.size = {0.12, leaf.size.y() + 0.10};
  handle.z0 = leaf.z0 + 1.02;
  handle.z1 = handle.z0 + 0.025;
  list.AddBox(handle, traits);
}

// Two raised panels on each side, so that a door looks like one.
void AddPanels(const HomeBox& leaf, const SurfaceTraits& traits, SurfaceList& list) {
  constexpr double kRaise_m = 0.008;
  const Vector2d across(-std::sin(leaf.yaw_rad), std::cos(leaf.yaw_rad));
  for (const double side : {-1.0, 1.0}) {
    HomeBox panel = leaf;
    panel.center += side * 0.5 * (leaf.size.y() + kRaise_m) * across;
    panel.size = {leaf.size.x() - 0.26, kRaise_m};
    for (const auto& [low_m, high_m] : {std::pair(0.15, 0.88), std::pair(1.08, 1.85)}) {
      panel.z0 = leaf.z0 + low_m;
      panel.z1 = std::min(leaf.z0 + high_m, leaf.z1 - 0.05);
      list.AddBox(panel, traits);
    }
  }
}

void AddDoorLeaf(const HomeOpening& door, const HomeWall& wall, std::pair<double, double> on,
                 const SurfaceTraits& look, SurfaceList& list) {
  constexpr double kLeafDepth_m = 0.04;
  SurfaceTraits traits = look;
  traits.room_id = wall.room_id;
  if (door.leaf == DoorLeaf::kOpen) {
    const HomeBox leaf = OpenLeaf(door);
    list.AddBox(leaf, traits);
    AddPanels(leaf, traits, list);
    AddHandles(leaf, true, list);
  } else if (door.leaf == DoorLeaf::kClosed) {
    traits.label = SurfaceLabel::kWall;
    traits.wall_id = wall.id;
    const HomeBox leaf =
        BoxOnWall(wall, on.first, on.second, -kLeafDepth_m - 0.01, -0.01, door.sill_z, door.head_z);
    list.AddBox(leaf, traits);
    AddPanels(leaf, traits, list);
    AddHandles(leaf, door.is_hinge_at_a, list);
  }
}

void AddWindow(const HomeOpening& window, const HomeWall& wall, std::pair<double, double> on,
               SurfaceList& list) {
  constexpr double kBar_m = 0.06;
  const SurfaceTraits traits = WallTraits(wall, {0.82f, 0.82f, 0.81f});
  const double d0 = -0.62 * window.thickness_m, d1 = d0 + 0.055;
  const auto [u0, u1] = on;
  const double z0 = window.sill_z, z1 = window.head_z;
  const auto add = [&](double from, double to, double low, double high) {
    list.AddBox(BoxOnWall(wall, from, to, d0, d1, low, high), traits);
  };
  add(u0, u0 + kBar_m, z0, z1);
  add(u1 - kBar_m, u1, z0, z1);
  add(u0 + kBar_m, u1 - kBar_m, z0, z0 + kBar_m);
  add(u0 + kBar_m, u1 - kBar_m, z1 - kBar_m, z1);
  if (u1 - u0 > 1.2)
    add(0.5 * (u0 + u1) - kBar_m / 2, 0.5 * (u0 + u1) + kBar_m / 2, z0 + kBar_m, z1 - kBar_m);
  // The sill board reaches a little into the room.
  list.AddBox(BoxOnWall(wall, u0 - 0.04, u1 + 0.04, 0, 0.035, z0 - 0.025, z0), traits);
}

}  // namespace

void AddTrim(const Home& home, SurfaceList& list) {
  const TrimColours colours = PickTrimColours(home);
  for (const HomeWall& wall : HomeWalls(home)) {
    AddBaseboards(home, wall, colours.baseboard, list);
    AddCrown(home, wall, list);
    for (const HomeOpening& opening : home.openings) {
      const auto on = OpeningOnWall(opening, wall);
      if (!on) continue;
      const bool is_own = opening.room_id == wall.room_id;
      if (opening.kind == OpeningKind::kWindow && is_own) AddWindow(opening, wall, *on, list);
      if (opening.kind != OpeningKind::kDoor) continue;
      AddCasing(opening, wall, *on, colours.frame, list);
      if (is_own) AddDoorLeaf(opening, wall, *on, colours.frame, list);
    }
  }
}

}  // namespace enfilade
