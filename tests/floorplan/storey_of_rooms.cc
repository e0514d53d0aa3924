// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/floorplan/storey_of_rooms.h"

#include <utility>

#include "tests/support/plan_fixtures.h"

namespace enfilade {

Storey StoreyOf(const std::vector<Polygon2>& polygons) {
  std::vector<Room> rooms;
  for (const Polygon2& polygon : polygons) {
    Room& room = rooms.emplace_back();
    room.id = static_cast<int>(rooms.size()) - 1;
    room.polygon = polygon;
    room.ceiling_z = 2.4;
  }
  Storey storey = std::move(MakePlan(std::move(rooms), 0.12).storeys[0]);
  for (Wall& wall : storey.walls) wall.sigma_m = 0.02;
  return storey;
}

}  // namespace enfilade
