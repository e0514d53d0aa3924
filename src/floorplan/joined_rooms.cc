// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/joined_rooms.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMaxThickness_m = 1.0;
constexpr double kOverlap_m = 0.001;

bool JoinsRooms(const Opening& opening) {
  return opening.kind == OpeningKind::kOpening && opening.other_room_id &&
         (opening.b - opening.a).norm() > kRoomJoiningOpening_m;
}

}  // namespace

std::vector<size_t> FirstJoinedRooms(const Storey& storey) {
  std::map<int, size_t> idx_of_id;
  for (size_t i = 0; i < storey.rooms.size(); ++i) idx_of_id[storey.rooms[i].id] = i;
  std::vector<size_t> first(storey.rooms.size());
  std::iota(first.begin(), first.end(), size_t{0});
  for (const Opening& opening : storey.openings) {
    if (!JoinsRooms(opening)) continue;
    const auto room = idx_of_id.find(opening.room_id);
    const auto other = idx_of_id.find(*opening.other_room_id);
    if (room == idx_of_id.end() || other == idx_of_id.end()) continue;
    const auto [low, high] = std::minmax({first[room->second], first[other->second]});
    std::replace(first.begin(), first.end(), high, low);
  }
  return first;
}

Vector2d ThroughWall(const Storey& storey, const Opening& opening) {
  const auto wall = std::find_if(storey.walls.begin(), storey.walls.end(),
                                 [&](const Wall& w) { return w.id == opening.wall_id; });
  if (wall == storey.walls.end() || wall->a == wall->b) return Vector2d::Zero();
  const Vector2d along = (wall->b - wall->a).normalized();
  Vector2d outward(along.y(), -along.x());  // the first room is on the left
  if (opening.room_id != wall->room_id) outward = -outward;
  const Vector2d middle = 0.5 * (opening.a + opening.b);
  for (const Room& room : storey.rooms) {
    if (opening.other_room_id != room.id) continue;
    const double distance = RayDistance(room.polygon.outer, middle, outward);
    if (distance <= kMaxThickness_m) return distance * outward;
  }
  return wall->thickness_m * outward;
}

std::vector<MultiPolygon2> Passages(const Storey& storey) {
  std::vector<MultiPolygon2> passages(storey.rooms.size());
  for (size_t i = 0; i < storey.rooms.size(); ++i) {
    for (const Opening& opening : storey.openings) {
      if (opening.room_id != storey.rooms[i].id || !JoinsRooms(opening)) continue;
      const Vector2d through = ThroughWall(storey, opening);
      if (through == Vector2d::Zero()) continue;
      const Vector2d outward = through.normalized();
      // Files may draw an opening in the middle of its wall.
      const double back_m =
          RayDistance(storey.rooms[i].polygon.outer, 0.5 * (opening.a + opening.b), -outward);
      const Vector2d back = ((back_m <= kMaxThickness_m ? back_m : 0) + kOverlap_m) * outward;
      const Vector2d ahead = through + kOverlap_m * outward;
      Ring2 floor = {opening.a - back, opening.b - back, opening.b + ahead, opening.a + ahead};
      if (SignedArea(floor) < 0) std::reverse(floor.begin(), floor.end());
      passages[i] = Union(passages[i], {{std::move(floor), {}}});
    }
  }
  return passages;
}

}  // namespace enfilade
