// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "enfilade/geometry/boolean.h"
#include "enfilade/synthetic/home.h"
#include "src/synthetic/outline.h"
#include "src/synthetic/placement.h"
#include "src/synthetic/standing_space.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinWall_m = 0.05;
constexpr double kMinCameraClearance_m = 0.3;
constexpr double kTolerance_m2 = 1e-6;

using Problems = std::vector<std::string>;

void CheckRooms(const Home& home, Problems& problems) {
  for (const HomeRoom& room : home.rooms) {
    if (!IsSimple(room.polygon.outer) || SignedArea(room.polygon.outer) <= 0) {
      problems.push_back(
          fmt::format("room {}: its outline is not simple and counter-clockwise", room.id));
      return;
    }
    for (const Ring2& hole : room.polygon.holes) {
      const bool is_inside = Area(Difference({{hole, {}}}, {{room.polygon.outer, {}}})) == 0;
      if (!IsSimple(hole) || SignedArea(hole) >= 0 || !is_inside)
        problems.push_back(
            fmt::format("room {}: a pillar is not inside it and clockwise", room.id));
    }
    if (room.ceiling_z - room.floor_z < 1.8)
      problems.push_back(fmt::format("room {}: too low", room.id));
  }
  for (size_t i = 0; i < home.rooms.size(); ++i) {
    for (size_t j = i + 1; j < home.rooms.size(); ++j) {
      const MultiPolygon2 near = Offset({home.rooms[i].polygon}, kMinWall_m);
      if (Area(Intersection(near, {home.rooms[j].polygon})) > kTolerance_m2) {
        problems.push_back(
            fmt::format("rooms {} and {}: no wall between", home.rooms[i].id, home.rooms[j].id));
      }
    }
  }
}

void CheckOpenings(const Home& home, Problems& problems) {
  struct Place {
    int wall_id;
    double begin_m, end_m;
    int opening_id;
  };
  std::vector<Place> places;
  const std::vector<HomeWall> walls = HomeWalls(home);
  for (const HomeOpening& opening : home.openings) {
    const size_t wanted = opening.other_room_id ? 2 : 1;
    const size_t before = places.size();
    for (const HomeWall& wall : walls) {
      const auto on = OpeningOnWall(opening, wall);
      if (on) places.push_back({wall.id, on->first, on->second, opening.id});
    }
    if (places.size() - before != wanted) {
      problems.push_back(fmt::format("opening {}: lies on {} wall faces, not {}", opening.id,
                                     places.size() - before, wanted));
    }
    const HomeRoom& room = home.RoomById(opening.room_id);
    double lowest = room.ceiling_z;
    if (opening.other_room_id)
      lowest = std::min(lowest, home.RoomById(*opening.other_room_id).ceiling_z);
    if (opening.sill_z < room.floor_z || opening.head_z <= opening.sill_z ||
        opening.head_z >= lowest) {
      problems.push_back(fmt::format("opening {}: sill or head out of the wall", opening.id));
    }
  }
  for (size_t i = 0; i < places.size(); ++i) {
    for (size_t j = i + 1; j < places.size(); ++j) {
      const Place &p = places[i], &q = places[j];
      if (p.wall_id == q.wall_id && p.begin_m < q.end_m && q.begin_m < p.end_m) {
        problems.push_back(fmt::format("openings {} and {} overlap", p.opening_id, q.opening_id));
      }
    }
  }
}

void CheckFurniture(const Home& home, Problems& problems) {
  for (size_t i = 0; i < home.boxes.size(); ++i) {
    const HomeBox& box = home.boxes[i];
    const Ring2 footprint = box.Footprint();
    const HomeRoom& room = home.RoomById(box.room_id);
    if (!IsConvexInside(footprint, room.polygon) || box.z0 < room.floor_z - 1e-9 ||
        box.z1 > room.ceiling_z || box.z1 <= box.z0) {
      problems.push_back(fmt::format("box {}: leaves room {}", i, room.id));
    }
    for (const HomeOpening& opening : home.openings) {
      if (opening.kind == OpeningKind::kWindow || box.z0 >= opening.head_z) continue;
      for (const Ring2& part : DoorClearance(opening)) {
        if (DoConvexOverlap(footprint, part))
          problems.push_back(fmt::format("box {}: stands in the way of door {}", i, opening.id));
      }
    }
    for (size_t j = i + 1; j < home.boxes.size(); ++j) {
      const HomeBox& other = home.boxes[j];
      if (other.item == box.item || box.z0 >= other.z1 || other.z0 >= box.z1) continue;
      if (DoConvexOverlap(footprint, other.Footprint()))
        problems.push_back(fmt::format("boxes {} and {} overlap", i, j));
    }
  }
}

void CheckCameras(const Home& home, Problems& problems) {
  const StandingSpace space(home);
  for (const HomeCamera& camera : home.cameras) {
    const Vector2d p = camera.home_from_cam.translation.head<2>();
    const HomeRoom& room = home.RoomById(camera.room_id);
    const double z = camera.home_from_cam.translation.z();
    const bool is_in_room = space.RoomAt(p) == room.id;
    if (!is_in_room || space.Clearance(p) < kMinCameraClearance_m || z <= room.floor_z ||
        z >= room.ceiling_z) {
      problems.push_back(fmt::format("camera {}: not in free space", camera.picture));
    }
  }
}

}  // namespace

std::vector<std::string> HomeProblems(const Home& home) {
  Problems problems;
  CheckRooms(home, problems);
  if (!problems.empty()) return problems;  // the others need sound rooms
  CheckOpenings(home, problems);
  CheckFurniture(home, problems);
  CheckCameras(home, problems);
  return problems;
}

}  // namespace enfilade
