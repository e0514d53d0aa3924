// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/free_walls.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "enfilade/geometry/angles.h"
#include "src/synthetic/openings.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kTries = 40;

Ring2::iterator CornerAt(Ring2& ring, const Vector2d& p) {
  return std::find(ring.begin(), ring.end(), p);
}

// A bay in the middle of the stretch: 45° sides, a front parallel to the wall.
bool AddBay(Home& home, const SharedWall& stretch, Random& random) {
  const double length_m = stretch.end_m - stretch.begin_m;
  if (length_m < 2.4) return false;
  const double width_m = random.Millimetres(2.0, std::min(length_m - 0.4, 3.2));
  const double depth_m = random.Millimetres(0.35, std::min(0.7, 0.5 * (width_m - 0.9)));
  const Vector2d along = stretch.wall.Along(), out = -stretch.wall.Inward();
  const Vector2d begin = stretch.wall.a + (stretch.begin_m + 0.5 * (length_m - width_m)) * along;
  const Vector2d end = begin + width_m * along;
  Ring2& ring = RoomOf(home, stretch.wall).polygon.outer;
  ring.insert(CornerAt(ring, stretch.wall.a) + 1,
              {begin, begin + depth_m * (along + out), end + depth_m * (out - along), end});
  return true;
}

// A bow in the middle of the stretch: an arc of a circle in eight pieces.
bool AddBow(Home& home, const SharedWall& stretch, Random& random) {
  constexpr int kPieces = 8;
  const double length_m = stretch.end_m - stretch.begin_m;
  if (length_m < 2.4) return false;
  const double half_m = 0.5 * random.Millimetres(2.0, std::min(length_m - 0.4, 3.4));
  const double depth_m = random.Millimetres(0.4, 0.7);
  const double radius_m = 0.5 * (half_m * half_m / depth_m + depth_m);
  const double half_rad = std::asin(half_m / radius_m);
  const Vector2d along = stretch.wall.Along(), out = -stretch.wall.Inward();
  const Vector2d middle = stretch.wall.a + 0.5 * (stretch.begin_m + stretch.end_m) * along;
  std::vector<Vector2d> arc;
  for (int i = 0; i <= kPieces; ++i) {
    const double turn = half_rad * (2.0 * i / kPieces - 1);
    arc.push_back(middle + radius_m * std::sin(turn) * along +
                  (depth_m - radius_m + radius_m * std::cos(turn)) * out);
  }
  Ring2& ring = RoomOf(home, stretch.wall).polygon.outer;
  ring.insert(CornerAt(ring, stretch.wall.a) + 1, arc.begin(), arc.end());
  return true;
}

// Turns a wall by moving its start outwards along the wall before it: both must be outer walls to
// their ends, and meet in a convex corner.
bool TurnWall(Home& home, const std::vector<SharedWall>& stretches, const SharedWall& stretch,
              Random& random) {
  const HomeWall& wall = stretch.wall;
  const double length_m = (wall.b - wall.a).norm();
  const double turn_rad = random.Uniform(DegToRad(4), DegToRad(15));
  if (stretch.begin_m > 0.02 || stretch.end_m < length_m - 0.02 || length_m < 1.5) return false;
  Ring2& ring = RoomOf(home, stretch.wall).polygon.outer;
  const auto corner = CornerAt(ring, wall.a);
  const Vector2d before = corner == ring.begin() ? ring.back() : *(corner - 1);
  const Vector2d outwards = (wall.a - before).normalized();
  if (outwards.dot(wall.Inward()) > -1 + 1e-9) return false;
  const Vector2d moved = wall.a + length_m * std::tan(turn_rad) * outwards;
  const bool is_corner_free =
      std::any_of(stretches.begin(), stretches.end(), [&](const SharedWall& s) {
        return s.wall.b == wall.a && s.end_m > (s.wall.b - s.wall.a).norm() - 0.02;
      });
  if (!is_corner_free) return false;
  *corner = moved;
  return true;
}

}  // namespace

bool AddFreeWalls(Home& home, Random& random) {
  const int wanted =
      std::max(1, static_cast<int>(std::lround(0.2 * static_cast<double>(home.rooms.size()) +
                                               random.Uniform(-0.4, 0.4))));
  std::set<int> changed;
  for (int tries = 0; tries < kTries && static_cast<int>(changed.size()) < wanted; ++tries) {
    const std::vector<SharedWall> stretches = OuterStretches(home);
    if (stretches.empty()) return false;
    const SharedWall& stretch = random.Pick(stretches);
    if (changed.count(stretch.wall.room_id) > 0) continue;
    if (RoomOf(home, stretch.wall).use == RoomUse::kCloset) continue;
    const bool is_bay = random.Chance(0.5);
    if (is_bay ? AddBay(home, stretch, random) : TurnWall(home, stretches, stretch, random))
      changed.insert(stretch.wall.room_id);
  }
  return !changed.empty();
}

bool AddCurvedWall(Home& home, Random& random) {
  for (int tries = 0; tries < kTries; ++tries) {
    const std::vector<SharedWall> stretches = OuterStretches(home);
    if (stretches.empty()) return false;
    if (AddBow(home, random.Pick(stretches), random)) return true;
  }
  return false;
}

}  // namespace enfilade
