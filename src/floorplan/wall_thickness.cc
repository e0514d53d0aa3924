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

}  // namespace

std::optional<FarFace> FarFaceOf(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                                 const Vector2d& d, double min_cosine) {
  const double length_m = (b - a).norm();
  const Vector2d along = (b - a) / length_m;
  if (along.dot((d - c).normalized()) > -min_cosine) return std::nullopt;
  return FarFace{Vector2d(along.y(), -along.x()).dot(0.5 * (c + d) - a),
                 std::min(length_m, along.dot(c - a)) - std::max(0.0, along.dot(d - a))};
}

void MeasureThickness(double max_wall_m, Storey& storey) {
  const BoxIndex index = IndexWalls(storey.walls);
  for (Wall& wall : storey.walls) {
    const Wall* behind = nullptr;
    double gap_m = 0, most_m = kMinShare * (wall.b - wall.a).norm();
    for (const size_t i : index.Touching(Grown(BoxOf(wall.a, wall.b), max_wall_m))) {
      const Wall& other = storey.walls[i];
      if (other.room_id == wall.room_id) continue;
      const std::optional<FarFace> face = FarFaceOf(wall.a, wall.b, other.a, other.b, kParallel);
      if (!face || face->gap_m < kThinnest_m || face->gap_m > max_wall_m) continue;
      if (face->common_m <= most_m) continue;
      most_m = face->common_m;
      gap_m = face->gap_m;
      behind = &other;
    }
    if (behind == nullptr) continue;
    wall.other_room_id = behind->room_id;
    wall.thickness_m = gap_m;
    wall.is_thickness_measured =
        wall.seen != WallSeen::kInferred && behind->seen != WallSeen::kInferred;
  }
}

}  // namespace enfilade
