// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/niches.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "src/synthetic/openings.h"
#include "src/synthetic/outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kToCorner_m = 0.35;
constexpr double kFreeBefore_m = 1.6;  // floor that a chimney breast leaves before it
constexpr double kPillarGap_m = 1.0;

// Puts two corners `depth_m` to the right of the wall (negative: into the room) between two on it.
void InsertStep(Home& home, const HomeWall& wall, double begin_m, double end_m, double depth_m) {
  const Vector2d out = -wall.Inward();
  const Vector2d begin = wall.a + begin_m * wall.Along(), end = wall.a + end_m * wall.Along();
  Ring2& ring = RoomOf(home, wall).polygon.outer;
  ring.insert(std::find(ring.begin(), ring.end(), wall.a) + 1,
              {begin, begin + depth_m * out, end + depth_m * out, end});
}

// [begin, end] in the middle part of a stretch, none when the stretch is too short.
bool DrawSpan(double from_m, double to_m, double width_m, Random& random, double& begin_m) {
  const double slack_m = to_m - from_m - width_m - 2 * kToCorner_m;
  if (slack_m < 0) return false;
  begin_m = from_m + kToCorner_m + random.Millimetres(0, slack_m);
  return true;
}

bool AddNiche(Home& home, const std::set<int>& taken, Random& random, int& room_id) {
  const std::vector<SharedWall> stretches = OuterStretches(home);
  if (stretches.empty()) return false;
  const SharedWall& stretch = random.Pick(stretches);
  room_id = stretch.wall.room_id;
  const double width_m = random.Millimetres(0.8, 1.8);
  double begin_m = 0;
  if (taken.count(room_id) > 0 || RoomOf(home, stretch.wall).use == RoomUse::kCloset ||
      !DrawSpan(stretch.begin_m, stretch.end_m, width_m, random, begin_m)) {
    return false;
  }
  InsertStep(home, stretch.wall, begin_m, begin_m + width_m, random.Millimetres(0.3, 0.6));
  return true;
}

bool AddChimneyBreast(Home& home, const std::set<int>& taken, Random& random, int& room_id) {
  const std::vector<HomeWall> walls = HomeWalls(home);
  const HomeWall& wall = random.Pick(walls);
  room_id = wall.room_id;
  const HomeRoom& room = RoomOf(home, wall);
  const double width_m = random.Millimetres(0.9, 1.5), depth_m = random.Millimetres(0.25, 0.45);
  double begin_m = 0;
  // Another wall must keep its length for the doors: only long ones are broken.
  if (taken.count(room_id) > 0 || room.use == RoomUse::kCloset || room.use == RoomUse::kHall ||
      !DrawSpan(1.2, (wall.b - wall.a).norm(), width_m, random, begin_m)) {
    return false;
  }
  for (const double share : {0.0, 0.5, 1.0}) {
    const Vector2d from =
        wall.a + (begin_m + share * width_m) * wall.Along() + 1e-6 * wall.Inward();
    if (RayDistance(room.polygon.outer, from, wall.Inward()) < depth_m + kFreeBefore_m)
      return false;
  }
  InsertStep(home, wall, begin_m, begin_m + width_m, -depth_m);
  return true;
}

}  // namespace

bool AddNiches(Home& home, int count, Random& random) {
  constexpr int kTries = 60;
  std::set<int> taken;
  for (int tries = 0; tries < kTries && static_cast<int>(taken.size()) < count; ++tries) {
    int room_id = 0;
    const bool is_added = random.Chance(0.5) ? AddNiche(home, taken, random, room_id)
                                             : AddChimneyBreast(home, taken, random, room_id);
    if (is_added) taken.insert(room_id);
  }
  return static_cast<int>(taken.size()) >= count;
}

bool AddPillars(Home& home, int count, Random& random) {
  std::vector<HomeRoom*> rooms;
  for (HomeRoom& room : home.rooms) rooms.push_back(&room);
  std::stable_sort(rooms.begin(), rooms.end(), [](const HomeRoom* a, const HomeRoom* b) {
    return Area(a->polygon) > Area(b->polygon);
  });
  int added = 0;
  for (HomeRoom* room : rooms) {
    if (added == count) break;
    constexpr int kTries = 60;
    const Rectangle box = BoundsOf(room->polygon.outer);
    for (int tries = 0; tries < kTries; ++tries) {
      const double half_m = random.Millimetres(0.15, 0.225);
      const Vector2d p(random.Millimetres(box.min.x(), box.max.x()),
                       random.Millimetres(box.min.y(), box.max.y()));
      if (!Contains(room->polygon.outer, p)) continue;
      if (DistanceToRing(room->polygon.outer, p) < kPillarGap_m + std::sqrt(2.0) * half_m) continue;
      room->polygon.holes.push_back({p + Vector2d(-half_m, -half_m), p + Vector2d(-half_m, half_m),
                                     p + Vector2d(half_m, half_m), p + Vector2d(half_m, -half_m)});
      ++added;
      break;
    }
  }
  return added == count;
}

}  // namespace enfilade
