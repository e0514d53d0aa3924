// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/storeys.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "enfilade/base/check.h"
#include "src/synthetic/cameras.h"
#include "src/synthetic/outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloorThickness_m = 0.3;

double HighestCeiling(const Home& home) {
  double highest_z = -std::numeric_limits<double>::infinity();
  for (const HomeRoom& room : home.rooms) highest_z = std::max(highest_z, room.ceiling_z);
  return highest_z;
}

void MovePolygon(Polygon2& polygon, const Vector2d& by) {
  for (Vector2d& p : polygon.outer) p += by;
  for (Ring2& hole : polygon.holes) {
    for (Vector2d& p : hole) p += by;
  }
}

void MoveHome(Home& home, const Vector3d& by) {
  for (HomeRoom& room : home.rooms) {
    MovePolygon(room.polygon, by.head<2>());
    room.floor_z += by.z();
    room.ceiling_z += by.z();
  }
  for (HomeOpening& opening : home.openings) {
    opening.a += by.head<2>();
    opening.b += by.head<2>();
    opening.sill_z += by.z();
    opening.head_z += by.z();
  }
  for (HomeBox& box : home.boxes) {
    box.center += by.head<2>();
    box.z0 += by.z();
    box.z1 += by.z();
  }
  for (HomeLamp& lamp : home.lamps) lamp.center += by;
  for (HomeCamera& camera : home.cameras) {
    camera.home_from_cam.translation += by;
    if (camera.claimed_home_from_cam) camera.claimed_home_from_cam->translation += by;
  }
}

// Lets the numbers of rooms, openings, furniture and pictures go on where those of `below` end.
void Renumber(Home& home, const Home& below) {
  const int num_rooms = static_cast<int>(below.rooms.size());
  for (HomeRoom& room : home.rooms) {
    room.id += num_rooms;
    room.storey_idx = below.NumStoreys();
  }
  for (HomeOpening& opening : home.openings) {
    opening.id += static_cast<int>(below.openings.size());
    opening.room_id += num_rooms;
    if (opening.other_room_id) *opening.other_room_id += num_rooms;
  }
  const int num_items = below.boxes.empty() ? 0 : below.boxes.back().item + 1;
  for (HomeBox& box : home.boxes) {
    box.item += num_items;
    box.room_id += num_rooms;
  }
  for (HomeLamp& lamp : home.lamps) lamp.room_id += num_rooms;
  for (size_t i = 0; i < home.cameras.size(); ++i) {
    home.cameras[i].picture = PictureName(below.cameras.size() + i);
    home.cameras[i].room_id += num_rooms;
  }
}

template <typename T>
void Append(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

void AddStorey(Home storey, Home& home) {
  const Vector2d aside = GroundOf(home).Center() - GroundOf(storey).Center();
  const double up = HighestCeiling(home) + kFloorThickness_m - storey.rooms[0].floor_z;
  MoveHome(storey, {aside.x(), aside.y(), up});
  Renumber(storey, home);
  Append(storey.rooms, home.rooms);
  Append(storey.openings, home.openings);
  Append(storey.boxes, home.boxes);
  Append(storey.lamps, home.lamps);
  Append(storey.cameras, home.cameras);
}

}  // namespace

Rectangle GroundOf(const Home& home) {
  Ring2 corners;
  for (const HomeRoom& room : home.rooms) Append(room.polygon.outer, corners);
  return BoundsOf(corners);
}

Home StackStoreys(std::vector<Home> storeys) {
  ENFILADE_CHECK(!storeys.empty());
  std::stable_sort(storeys.begin(), storeys.end(), [](const Home& a, const Home& b) {
    return GroundOf(a).Area() > GroundOf(b).Area();
  });
  Home home = std::move(storeys[0]);
  for (size_t i = 1; i < storeys.size(); ++i) AddStorey(std::move(storeys[i]), home);
  return home;
}

}  // namespace enfilade
