// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/floorplan/storey_of_rooms.h"

namespace enfilade {

Storey StoreyOf(const std::vector<Polygon2>& rooms) {
  Storey storey;
  for (const Polygon2& polygon : rooms) {
    Room room;
    room.id = static_cast<int>(storey.rooms.size());
    room.polygon = polygon;
    room.ceiling_z = 2.4;
    storey.rooms.push_back(room);
    const Ring2& ring = polygon.outer;
    for (size_t i = 0; i < ring.size(); ++i) {
      Wall wall;
      wall.id = static_cast<int>(storey.walls.size());
      wall.a = ring[i];
      wall.b = ring[(i + 1) % ring.size()];
      wall.room_id = room.id;
      wall.thickness_m = 0.12;
      wall.sigma_m = 0.02;
      storey.walls.push_back(wall);
    }
  }
  return storey;
}

}  // namespace enfilade
