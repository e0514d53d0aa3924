// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "enfilade/geometry/boolean.h"
#include "enfilade/synthetic/home.h"
#include "src/synthetic/outline.h"
#include "src/synthetic/placement.h"
#include "src/synthetic/standing_space.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinWall_m = 0.05;
constexpr double kMinFloor_m = 0.2;  // between storeys
constexpr double kMinCameraClearance_m = 0.3;
constexpr double kTolerance_m2 = 1e-6;

using Problems = std::vector<std::string>;

// Booleans are asked of neighbours only: of all pairs of a large building they would take minutes.
void CheckWallsBetween(const Home& home, Problems& problems) {
  std::vector<Rectangle> bounds;
  for (const HomeRoom& room : home.rooms) bounds.push_back(BoundsOf(room.polygon.outer));
  for (size_t i = 0; i < home.rooms.size(); ++i) {
    const MultiPolygon2 near = Offset({home.rooms[i].polygon}, kMinWall_m);
    for (size_t j = i + 1; j < home.rooms.size(); ++j) {
      if (home.rooms[j].storey_idx != home.rooms[i].storey_idx) continue;
      if (!AreNear(bounds[i], bounds[j], kMinWall_m)) continue;
      if (Area(Intersection(near, {home.rooms[j].polygon})) > kTolerance_m2) {
        problems.push_back(
            fmt::format("rooms {} and {}: no wall between", home.rooms[i].id, home.rooms[j].id));
      }
    }
  }
}

// Every storey has rooms, and the highest ceiling of one is below the lowest floor of the next.
void CheckStoreys(const Home& home, Problems& problems) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto num_storeys = static_cast<size_t>(home.NumStoreys());
  std::vector<double> floor_z(num_storeys, kInfinity), ceiling_z(num_storeys, -kInfinity);
  for (const HomeRoom& room : home.rooms) {
    if (room.storey_idx < 0) {
      problems.push_back(fmt::format("room {}: on no storey", room.id));
      return;
    }
    const auto i = static_cast<size_t>(room.storey_idx);
    floor_z[i] = std::min(floor_z[i], room.floor_z);
    for (const Vector2d& corner : room.polygon.outer)
      ceiling_z[i] = std::max(ceiling_z[i], room.CeilingAt(corner));
  }
  for (size_t i = 0; i < num_storeys; ++i) {
    if (floor_z[i] == kInfinity) problems.push_back(fmt::format("storey {}: no room", i));
    if (i > 0 && floor_z[i] < ceiling_z[i - 1] + kMinFloor_m)
      problems.push_back(fmt::format("storey {}: no floor between it and the one below", i));
  }
}

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
  CheckWallsBetween(home, problems);
  CheckStoreys(home, problems);
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
    if (opening.other_room_id) {
      const HomeRoom& other = home.RoomById(*opening.other_room_id);
      lowest = std::min(lowest, other.ceiling_z);
      if (other.storey_idx != room.storey_idx)
        problems.push_back(fmt::format("opening {}: leads to another storey", opening.id));
    }
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

struct DoorFloor {
  int opening_id = 0, storey_idx = 0;
  double head_z = 0;
  Ring2 part;
  Rectangle bounds;
};

std::vector<DoorFloor> FloorBeforeDoors(const Home& home) {
  std::vector<DoorFloor> floors;
  for (const HomeOpening& opening : home.openings) {
    if (opening.kind == OpeningKind::kWindow) continue;
    const int storey_idx = home.RoomById(opening.room_id).storey_idx;
    for (const Ring2& part : DoorClearance(opening))
      floors.push_back({opening.id, storey_idx, opening.head_z, part, BoundsOf(part)});
  }
  return floors;
}

void CheckFurniture(const Home& home, Problems& problems) {
  const std::vector<DoorFloor> floors = FloorBeforeDoors(home);
  std::vector<Ring2> footprints;
  std::vector<Rectangle> bounds;
  for (const HomeBox& box : home.boxes) {
    footprints.push_back(box.Footprint());
    bounds.push_back(BoundsOf(footprints.back()));
  }
  for (size_t i = 0; i < home.boxes.size(); ++i) {
    const HomeBox& box = home.boxes[i];
    const Ring2& footprint = footprints[i];
    const HomeRoom& room = home.RoomById(box.room_id);
    if (!IsConvexInside(footprint, room.polygon) || box.z0 < room.floor_z - 1e-9 ||
        box.z1 > room.ceiling_z || box.z1 <= box.z0) {
      problems.push_back(fmt::format("box {}: leaves room {}", i, room.id));
    }
    for (const DoorFloor& floor : floors) {
      if (floor.storey_idx != room.storey_idx || box.z0 >= floor.head_z) continue;
      if (!AreNear(bounds[i], floor.bounds, 0)) continue;
      if (DoConvexOverlap(footprint, floor.part))
        problems.push_back(
            fmt::format("box {}: stands in the way of door {}", i, floor.opening_id));
    }
    for (size_t j = i + 1; j < home.boxes.size(); ++j) {
      const HomeBox& other = home.boxes[j];
      if (other.item == box.item || box.z0 >= other.z1 || other.z0 >= box.z1) continue;
      if (AreNear(bounds[i], bounds[j], 0) && DoConvexOverlap(footprint, footprints[j]))
        problems.push_back(fmt::format("boxes {} and {} overlap", i, j));
    }
  }
}

void CheckCameras(const Home& home, Problems& problems) {
  std::vector<StandingSpace> storeys;
  for (int i = 0; i < home.NumStoreys(); ++i) storeys.emplace_back(home, i);
  for (const HomeCamera& camera : home.cameras) {
    const HomeRoom& room = home.RoomById(camera.room_id);
    const StandingSpace& space = storeys[static_cast<size_t>(room.storey_idx)];
    const Vector2d p = camera.home_from_cam.translation.head<2>();
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
