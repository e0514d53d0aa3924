// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// A room from text ("0,0 4,0 4,3 0,3", holes clockwise) between two heights.
inline Room MakeRoom(int id, std::string_view outer,
                     std::initializer_list<std::string_view> holes = {}, double floor_z = 0,
                     double ceiling_z = 2.4) {
  Room room;
  room.id = id;
  room.polygon.outer = ParseRing(outer);
  for (const std::string_view hole : holes) room.polygon.holes.push_back(ParseRing(hole));
  room.floor_z = floor_z;
  room.ceiling_z = ceiling_z;
  return room;
}

/// A plan of one storey whose walls are the rooms' edges, numbered from 0 in their order.
inline Floorplan MakePlan(std::vector<Room> rooms, double thickness_m = 0.1) {
  Storey storey;
  for (const Room& room : rooms) {
    std::vector<Ring2> rings{room.polygon.outer};
    rings.insert(rings.end(), room.polygon.holes.begin(), room.polygon.holes.end());
    for (const Ring2& ring : rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        Wall wall;
        wall.id = static_cast<int>(storey.walls.size());
        wall.a = ring[i];
        wall.b = ring[(i + 1) % ring.size()];
        wall.room_id = room.id;
        wall.thickness_m = thickness_m;
        storey.walls.push_back(wall);
      }
    }
  }
  storey.floor_z = rooms.empty() ? 0 : rooms.front().floor_z;
  storey.rooms = std::move(rooms);
  Floorplan plan;
  plan.storeys.push_back(std::move(storey));
  return plan;
}

}  // namespace enfilade
