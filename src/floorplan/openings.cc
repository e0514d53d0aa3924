// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/openings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "enfilade/floorplan/solve.h"
#include "src/floorplan/facade_store.h"
#include "src/floorplan/pictured_wall.h"
#include "src/floorplan/shut_closets.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kBesideDoor_m = 0.12;
constexpr double kMinJoined_m2 = 4;  // of rooms that an opening joins
// Log-odds of a door in a wall that rooms go on beside: what could be there is a closet or a niche
// of the outer wall, so doors are more frequent than among all frames.
constexpr double kBeforeCloset = 1.5;

const Room& RoomOf(const Storey& storey, int room_id) {
  return *std::find_if(storey.rooms.begin(), storey.rooms.end(),
                       [&](const Room& room) { return room.id == room_id; });
}

// The first room met on the way out through the wall.
std::optional<int> RoomBehind(const Storey& storey, const DoorCandidate& door, double max_wall_m) {
  constexpr double kStep_m = 0.05;
  for (double depth_m = kStep_m; depth_m < max_wall_m + kStep_m; depth_m += kStep_m) {
    const Vector2d p = door.Middle() + depth_m * door.Outward();
    for (const Room& room : storey.rooms) {
      if (Contains(room.polygon, p)) return room.id;
    }
  }
  return std::nullopt;
}

// Of doors beside each other in one wall the surer one stays: the other is its leaf, which stands
// open before the wall, or its casing.
std::vector<DoorCandidate> WithoutNeighbours(const std::vector<DoorCandidate>& doors) {
  std::vector<DoorCandidate> kept;
  for (const DoorCandidate& door : doors) {
    const bool is_beside = std::any_of(kept.begin(), kept.end(), [&](const DoorCandidate& other) {
      const double gap_m = std::max(other.frame.begin_m, door.frame.begin_m) -
                           std::min(other.frame.end_m, door.frame.end_m);
      return other.wall == door.wall && gap_m < kBesideDoor_m;
    });
    if (!is_beside) kept.push_back(door);
  }
  return kept;
}

double AreaOfRoom(const Storey& storey, int room_id) {
  return Area(RoomOf(storey, room_id).polygon);
}

// The openings that lead from one room to another; a wide way into a closet is its door.
std::vector<DoorCandidate> BetweenRooms(const Storey& storey,
                                        const std::vector<DoorCandidate>& openings,
                                        const std::vector<int>& room_of_wall, double max_wall_m) {
  std::vector<DoorCandidate> kept;
  for (const DoorCandidate& opening : openings) {
    const std::optional<int> behind = RoomBehind(storey, opening, max_wall_m);
    if (!behind || std::min(AreaOfRoom(storey, room_of_wall[opening.wall]),
                            AreaOfRoom(storey, *behind)) < kMinJoined_m2) {
      continue;
    }
    kept.push_back(opening);
  }
  return kept;
}

void AddOpening(const DoorCandidate& door, OpeningKind kind, const Wall& wall, double max_wall_m,
                Storey& storey) {
  const Room& room = RoomOf(storey, wall.room_id);
  Opening opening;
  opening.id = static_cast<int>(storey.openings.size());
  opening.kind = kind;
  opening.wall_id = wall.id;
  opening.a = door.a;
  opening.b = door.b;
  opening.sill_z = room.floor_z + door.sill_m;
  opening.head_z = room.floor_z + door.frame.head_m;
  opening.room_id = room.id;
  opening.other_room_id = RoomBehind(storey, door, max_wall_m);
  storey.openings.push_back(opening);
}

}  // namespace

void OpeningOptions::Visit(OptionVisitor& v) {
  v("step_m", step_m, "Size of what is looked at on a wall.", {0.005, 0.1});
  v("min_door_log_odds", min_door_log_odds, "How sure a door must be: natural log-odds.",
    {-20, 20});
  v("min_opening_strength", min_opening_strength,
    "How clear head and jambs of a wide opening must be together.", {0, 2});
  v("min_window_strength", min_window_strength,
    "How clear the four sides of a window must be together.", {0, 4});
  v("max_wall_m", max_wall_m, "Thickest wall that a door leads through.", {0.01, 2});
}

OpeningReport FindOpenings(const Scene& scene, const FloorplanOptions& floorplan_options,
                           RunContext& context, Floorplan& plan, FacadeStore* facades) {
  const OpeningOptions& options = floorplan_options.openings;
  OpeningReport report;
  std::vector<PicturedWall> walls;
  std::vector<size_t> wall_idx;  // in its storey, of every pictured wall
  std::vector<int> room_of_wall;
  for (size_t s = 0; s < plan.storeys.size(); ++s) {
    const Storey& storey = plan.storeys[s];
    const ClosetFinder closets(floorplan_options, storey);
    for (size_t w = 0; w < storey.walls.size(); ++w) {
      const Wall& wall = storey.walls[w];
      if ((wall.b - wall.a).norm() < kMinPicturedWall_m) continue;
      const Room& room = RoomOf(storey, wall.room_id);
      wall_idx.push_back(w);
      room_of_wall.push_back(room.id);
      walls.emplace_back(wall.a, wall.b, static_cast<int>(s), room.polygon, room.floor_z,
                         room.ceiling_z, options.step_m);
      if (!closets.Behind(wall).outer.empty()) walls.back().door_log_odds = kBeforeCloset;
    }
  }
  FacadeStore none(context);
  LookAtWalls(scene, plan.home_from_world, facades != nullptr ? *facades : none, context, walls);
  const std::optional<double> head_m = FindFrames(context, walls);
  report.door_head_m = head_m.value_or(0);
  for (size_t s = 0; s < plan.storeys.size(); ++s) {
    Storey& storey = plan.storeys[s];
    const int storey_idx = static_cast<int>(s);
    const auto add = [&](const std::vector<DoorCandidate>& found, OpeningKind kind) {
      for (const DoorCandidate& door : found)
        AddOpening(door, kind, storey.walls[wall_idx[door.wall]], options.max_wall_m, storey);
      return static_cast<int>(found.size());
    };
    std::vector<DoorCandidate> doors;
    if (head_m) {
      doors = FindDoors(walls, storey_idx, CamerasInPlan(scene, plan.home_from_world, storey_idx),
                        *head_m, options.max_wall_m);
    }
    std::erase_if(doors, [&](const DoorCandidate& door) {
      return door.log_odds < options.min_door_log_odds;
    });
    doors = WithoutNeighbours(doors);
    std::vector<DoorCandidate> openings = BetweenRooms(
        storey,
        FindWideOpenings(walls, storey_idx, options.min_opening_strength, options.max_wall_m),
        room_of_wall, options.max_wall_m);
    const auto is_among = [&](const std::vector<DoorCandidate>& others, const DoorCandidate& one) {
      return std::any_of(others.begin(), others.end(), [&](const DoorCandidate& other) {
        return AreInOnePlace(other, one, options.max_wall_m);
      });
    };
    // A door with its leaf beside it looks like an opening; what is as wide as an opening is none.
    const auto is_narrow = [](const DoorCandidate& door) { return !IsWide(door.frame); };
    std::vector<DoorCandidate> narrow;
    std::copy_if(doors.begin(), doors.end(), std::back_inserter(narrow), is_narrow);
    std::erase_if(openings,
                  [&](const DoorCandidate& opening) { return is_among(narrow, opening); });
    std::erase_if(doors, [&](const DoorCandidate& door) { return is_among(openings, door); });
    report.num_doors += add(doors, OpeningKind::kDoor);
    report.num_openings += add(openings, OpeningKind::kOpening);
    std::vector<DoorCandidate> windows =
        FindWindows(walls, storey_idx, options.min_window_strength);
    std::erase_if(windows, [&](const DoorCandidate& window) {
      return RoomBehind(storey, window, options.max_wall_m) || is_among(doors, window) ||
             is_among(openings, window);
    });
    report.num_windows += add(windows, OpeningKind::kWindow);
  }
  for (Storey& storey : plan.storeys)
    report.num_closets += AddShutClosets(floorplan_options, storey);
  return report;
}

}  // namespace enfilade
