// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/wall_thickness.h"

#include <algorithm>

#include "src/floorplan/box_index.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kParallel = 0.985;  // cosine
constexpr double kMinShare = 0.3;    // of a wall's length that the other face must be behind
constexpr double kThinnest_m = 0.03;

// How far the far face lies behind the wall.
double GapBetween(const Wall& wall, const Wall& other) {
  const Vector2d along = (wall.b - wall.a).normalized();
  return Vector2d(along.y(), -along.x()).dot(0.5 * (other.a + other.b) - wall.a);
}

// The part of `wall` behind which `other` is its far face, 0 if it is not.
double CommonLength(const Wall& wall, const Wall& other, double max_wall_m) {
  const Vector2d along = (wall.b - wall.a).normalized();
  if (along.dot((other.b - other.a).normalized()) > -kParallel) return 0;
  const double gap_m = GapBetween(wall, other);
  if (gap_m < kThinnest_m || gap_m > max_wall_m) return 0;
  return std::min((wall.b - wall.a).norm(), along.dot(other.a - wall.a)) -
         std::max(0.0, along.dot(other.b - wall.a));
}

}  // namespace

void MeasureThickness(double max_wall_m, Storey& storey) {
  const BoxIndex index = IndexWalls(storey.walls);
  for (Wall& wall : storey.walls) {
    const Wall* far_face = nullptr;
    double most = kMinShare * (wall.b - wall.a).norm();
    for (const size_t i : index.Touching(Grown(BoxOf(wall.a, wall.b), max_wall_m))) {
      const Wall& other = storey.walls[i];
      if (other.room_id == wall.room_id) continue;
      const double common = CommonLength(wall, other, max_wall_m);
      if (common <= most) continue;
      most = common;
      far_face = &other;
    }
    if (far_face == nullptr) continue;
    wall.other_room_id = far_face->room_id;
    wall.thickness_m = GapBetween(wall, *far_face);
    wall.is_thickness_measured =
        wall.seen != WallSeen::kInferred && far_face->seen != WallSeen::kInferred;
  }
}

}  // namespace enfilade
