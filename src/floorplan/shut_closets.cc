// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/shut_closets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "enfilade/geometry/boolean.h"
#include "src/floorplan/closet.h"
#include "src/floorplan/rooms.h"
#include "src/floorplan/sound_polygon.h"
#include "src/floorplan/wall_thickness.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kCollinear_m = 1e-6;
constexpr double kInLine_m = 0.1;
constexpr double kParallel = 0.98;  // cosine
constexpr double kBeside_m = 0.1;   // how far inside a room beside the closet is looked

std::vector<Box2> BoxesOf(const Storey& storey) {
  std::vector<Box2> boxes;
  for (const Room& room : storey.rooms) boxes.push_back(BoxOf(room.polygon.outer));
  return boxes;
}

void AddCloset(const Polygon2& polygon, double floor_z, double ceiling_z, double thickness_m,
               Storey& storey) {
  Room closet;
  closet.id = static_cast<int>(storey.rooms.size());
  closet.polygon = polygon;
  closet.floor_z = floor_z;
  closet.ceiling_z = ceiling_z;
  for (size_t i = AppendWalls(closet, thickness_m, storey); i < storey.walls.size(); ++i)
    storey.walls[i].seen = WallSeen::kInferred;
  storey.rooms.push_back(std::move(closet));
}

}  // namespace

ClosetFinder::ClosetFinder(const FloorplanOptions& options, const Storey& storey)
    : options_(options),
      storey_(storey),
      rooms_(BoxesOf(storey)),
      walls_(IndexWalls(storey.walls)) {}

// How far rooms go on past a wall, beside its end: `aside` is the direction from the wall to there.
double ClosetFinder::DepthBeside(const Vector2d& end, const Vector2d& aside,
                                 const Vector2d& outward) const {
  const Vector2d from = end + (kThickestWall_m + kBeside_m) * aside + kClosetDepth_m * outward;
  for (const size_t i : rooms_.Touching(BoxOf(from, from))) {
    const Polygon2& room = storey_.rooms[i].polygon;
    if (Contains(room, from)) return kClosetDepth_m + RayDistance(room.outer, from, outward);
  }
  return std::numeric_limits<double>::infinity();
}

// How much of other walls lies on the line through a point along a wall, rooms on the same side.
double ClosetFinder::LengthInLine(const Vector2d& on_line, const Wall& wall) const {
  const Vector2d along = (wall.b - wall.a).normalized(), normal(-along.y(), along.x());
  const Vector2d reach = walls_.bounds().diagonal().norm() * along;
  double sum_m = 0;
  for (const size_t i :
       walls_.Touching(Grown(BoxOf(on_line - reach, on_line + reach), kInLine_m))) {
    const Wall& other = storey_.walls[i];
    if (&other == &wall || along.dot((other.b - other.a).normalized()) < kParallel) continue;
    if (std::abs(normal.dot(0.5 * (other.a + other.b) - on_line)) <= kInLine_m)
      sum_m += (other.b - other.a).norm();
  }
  return sum_m;
}

Polygon2 ClosetFinder::Behind(const Wall& wall) const {
  const Vector2d along = (wall.b - wall.a).normalized(), outward(along.y(), -along.x());
  const double depth_m =
      std::min(DepthBeside(wall.a, -along, outward), DepthBeside(wall.b, along, outward));
  if (depth_m > options_.unseen_gap_m) return {};
  const Vector2d out = depth_m * outward;
  // Else it is the room beside it that ends too far out.
  if (LengthInLine(wall.a, wall) > LengthInLine(wall.a + out, wall)) return {};
  const Polygon2 space{{wall.b, wall.a, wall.a + out, wall.b + out}, {}};
  MultiPolygon2 near;
  for (const size_t i : rooms_.Touching(Grown(BoxOf(space.outer), options_.wall_thickness_m)))
    near.push_back({storey_.rooms[i].polygon.outer, {}});
  const Polygon2 closet = LargestRoom(
      OpenSharp(Difference({space}, OffsetSharp(near, options_.wall_thickness_m)), kClosetDepth_m),
      kCollinear_m);
  const double area_m2 = Area(closet);
  return area_m2 >= kClosetArea_m2 && area_m2 <= options_.unseen_hole_m2 ? closet : Polygon2{};
}

int AddShutClosets(const FloorplanOptions& options, Storey& storey) {
  int num_closets = 0;
  std::optional<ClosetFinder> finder;  // until a closet changes the storey
  for (Opening& door : storey.openings) {
    if (door.kind != OpeningKind::kDoor || door.other_room_id) continue;
    if (!finder) finder.emplace(options, storey);
    const Polygon2 closet = finder->Behind(storey.walls[static_cast<size_t>(door.wall_id)]);
    if (closet.outer.empty()) continue;
    finder.reset();
    const Room& room = storey.rooms[static_cast<size_t>(door.room_id)];
    door.other_room_id = static_cast<int>(storey.rooms.size());
    AddCloset(closet, room.floor_z, room.ceiling_z, options.wall_thickness_m, storey);
    ++num_closets;
  }
  if (num_closets > 0) MeasureThickness(options.openings.max_wall_m, storey);
  return num_closets;
}

}  // namespace enfilade
