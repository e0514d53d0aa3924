// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/vertex_dial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

/// Cheapest ways to give the first rooms so many corners together.
struct DialEntry {
  double cost_m = std::numeric_limits<double>::infinity();
  size_t choice = 0;  ///< of the last of these rooms
};
using DialLayer = std::map<int, DialEntry>;  // by number of corners

std::vector<const Room*> RoomsWithCurve(const Floorplan& plan) {
  std::vector<const Room*> rooms;
  for (const Storey& storey : plan.storeys) {
    for (const Room& room : storey.rooms) {
      if (!room.curve.empty()) rooms.push_back(&room);
    }
  }
  return rooms;
}

std::vector<DialLayer> MakeLayers(const std::vector<const Room*>& rooms) {
  std::vector<DialLayer> layers = {{{0, {0, 0}}}};
  for (const Room* room : rooms) {
    DialLayer layer;
    for (const auto& [num_before, before] : layers.back()) {
      for (size_t i = 0; i < room->curve.size(); ++i) {
        DialEntry& entry = layer[num_before + room->curve[i].NumVertices()];
        const double cost_m = before.cost_m + room->curve[i].cost_m;
        if (cost_m < entry.cost_m) entry = {cost_m, i};
      }
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

}  // namespace

std::vector<int> VertexNumbers(const Floorplan& plan) {
  const std::vector<const Room*> rooms = RoomsWithCurve(plan);
  std::vector<int> numbers;
  if (rooms.empty()) return numbers;
  const std::vector<DialLayer> layers = MakeLayers(rooms);
  for (const auto& [number, entry] : layers.back()) numbers.push_back(number);
  return numbers;
}

std::string WhyNoSuchNumber(const Floorplan& plan, int num_vertices) {
  const std::vector<int> numbers = VertexNumbers(plan);
  if (numbers.empty()) return "the plan has no curve of corners: only mode paper makes one";
  const int nearest = *std::min_element(numbers.begin(), numbers.end(), [&](int a, int b) {
    return std::abs(a - num_vertices) < std::abs(b - num_vertices);
  });
  return fmt::format("there is no plan with {} corners; the nearest has {} (of {} to {})",
                     num_vertices, nearest, numbers.front(), numbers.back());
}

void TakeOutline(const OutlineChoice& outline, double wall_thickness_m, Room& room,
                 Storey& storey) {
  room.polygon = outline.polygon;
  double variance = 0;
  size_t edge = 0;
  for (const Ring2& ring : RingsOf(outline.polygon)) {
    for (size_t i = 0; i < ring.size(); ++i, ++edge) {
      Wall wall;
      wall.id = static_cast<int>(storey.walls.size());
      wall.a = ring[i];
      wall.b = ring[(i + 1) % ring.size()];
      wall.room_id = room.id;
      wall.thickness_m = wall_thickness_m;
      wall.seen = outline.seen.at(edge);
      wall.sigma_m = outline.sigma_m.at(edge);
      variance += (wall.b - wall.a).squaredNorm() * wall.sigma_m * wall.sigma_m;
      storey.walls.push_back(std::move(wall));
    }
  }
  room.area_sigma_m2 = std::sqrt(variance);
}

std::optional<Floorplan> PlanWithVertices(const Floorplan& plan, int num_vertices) {
  const std::vector<const Room*> rooms = RoomsWithCurve(plan);
  const std::vector<DialLayer> layers = MakeLayers(rooms);
  if (rooms.empty() || !layers.back().contains(num_vertices)) return std::nullopt;
  std::vector<size_t> choices(rooms.size());
  int rest = num_vertices;
  for (size_t i = rooms.size(); i-- > 0;) {
    choices[i] = layers[i + 1].at(rest).choice;
    rest -= rooms[i]->curve[choices[i]].NumVertices();
  }
  Floorplan dialled = plan;
  auto choice = choices.begin();
  for (Storey& storey : dialled.storeys) {
    const std::vector<Wall> walls = std::exchange(storey.walls, {});
    std::map<int, int> new_id;
    for (Room& room : storey.rooms) {
      const auto is_of_room = [&](const Wall& wall) { return wall.room_id == room.id; };
      if (!room.curve.empty()) {
        const auto wall = std::find_if(walls.begin(), walls.end(), is_of_room);
        ENFILADE_CHECK(wall != walls.end());
        TakeOutline(room.curve[*choice++], wall->thickness_m, room, storey);
        continue;
      }
      for (const Wall& wall : walls) {
        if (!is_of_room(wall)) continue;
        storey.walls.push_back(wall);
        storey.walls.back().id = static_cast<int>(storey.walls.size()) - 1;
        new_id[wall.id] = storey.walls.back().id;
      }
    }
    for (Opening& opening : storey.openings) opening.wall_id = new_id.at(opening.wall_id);
  }
  return dialled;
}

}  // namespace enfilade
