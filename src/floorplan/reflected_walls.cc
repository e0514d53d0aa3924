// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/reflected_walls.h"

#include <algorithm>
#include <cmath>

#include "src/floorplan/closet.h"
#include "src/floorplan/edge_cost.h"
#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kPiece_m = 0.25;     // of a wall
constexpr double kReach_m = 0.1;      // how far off its reflection a wall may stand
constexpr double kFacing = 0.7;       // cosine
constexpr double kMirrorShare = 0.7;  // of the walls

class Comparison {
 public:
  Comparison(const LoopField& field, const Neck& neck)
      : field_(field), origin_(neck.a), along_((neck.b - neck.a).normalized()) {}

  void AddWall(const Vector2d& a, const Vector2d& b) {
    const Vector2d middle = 0.5 * (a + b);
    const bool is_facing = std::abs(along_.dot((b - a).normalized())) > kFacing &&
                           (middle - Reflect(middle)).norm() > 2 * kThickestWall_m;
    const int num_pieces = std::max(1, static_cast<int>(std::lround((b - a).norm() / kPiece_m)));
    for (int k = 0; k < num_pieces; ++k) {
      const Vector2d from = a + static_cast<double>(k) / num_pieces * (b - a);
      const Vector2d to = a + static_cast<double>(k + 1) / num_pieces * (b - a);
      const double seen_m = SeenShare(field_, from, to) * (to - from).norm();
      // Reflected, the wall runs the other way round its room.
      const bool is_repeated =
          MeasureWallBand(field_, Reflect(to), Reflect(from), kReach_m).has_peak;
      const double repeated_m = is_repeated ? seen_m : 0;
      walls_.seen_m += seen_m;
      walls_.repeated_m += repeated_m;
      if (!is_facing) continue;
      walls_.facing_seen_m += seen_m;
      walls_.facing_repeated_m += repeated_m;
    }
  }

  [[nodiscard]] const ReflectedWalls& walls() const { return walls_; }

 private:
  [[nodiscard]] Vector2d Reflect(const Vector2d& p) const {
    return 2 * (origin_ + along_.dot(p - origin_) * along_) - p;
  }

  const LoopField& field_;
  Vector2d origin_, along_;
  ReflectedWalls walls_;
};

}  // namespace

bool ReflectedWalls::IsMirror() const {
  return facing_seen_m > 0 && facing_repeated_m >= kMirrorShare * facing_seen_m &&
         repeated_m >= kMirrorShare * seen_m;
}

ReflectedWalls CompareWithReflection(const LoopField& field, const Neck& neck) {
  Comparison comparison(field, neck);
  for (const auto& [a, b] : WallsBeyond(neck)) comparison.AddWall(a, b);
  return comparison.walls();
}

}  // namespace enfilade
