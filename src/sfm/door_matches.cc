// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/door_matches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/two_view.h"
#include "src/sfm/feature_sizes.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Sine of the elevation below which a ray is level.
constexpr double kLevel = 0.05;
constexpr double kMinParallax_rad = DegToRad(1.5);
// How far a point may lie off the surface that it should lie on: the outline's errors.
constexpr double kSurfaceShare = 0.08, kSurface_m = 0.05;
// A ray through the door meets its point this far beyond the own walls.
constexpr double kBeyond_m = 0.05;
constexpr double kHalfDoor_m = 0.45;
// One object, matched falsely, has many features: what is seen counts by places of this size.
constexpr double kSpot_m = 0.3;
constexpr double kNearest_m = 0.3, kFarthest_m = 9;

bool IsLevel(const Vector3d& ray) { return std::abs(ray.z()) < kLevel; }

bool IsOn(double distance_m, double surface_m) {
  return std::abs(distance_m - surface_m) < kSurfaceShare * surface_m + kSurface_m;
}

// A match that agrees with a placement.
struct Sight {
  size_t pair = 0, match = 0;
  Vector2d door{0, 0};         // where the line of sight leaves its own room
  std::array<long, 3> spot{};  // of what is seen
};

std::optional<Sight> SightOf(const ViewPairMatches& pair, size_t match, const RoomRay& b,
                             const Rigid3& transform, const TwoViewGeometry& geometry,
                             double baseline_m, double bound_rad) {
  const RoomRay& a = pair.rays_a[match];
  if (IsLevel(a.ray) || IsLevel(b.ray)) return std::nullopt;
  if (std::abs(EpipolarError(geometry, a.ray, b.ray)) > bound_rad) return std::nullopt;
  const Vector3d turned = geometry.a_from_b * b.ray;
  if (a.ray.cross(turned).norm() < kMinParallax_rad) return std::nullopt;
  const PairDepths depths = TriangulateDepths(geometry, a.ray, b.ray);
  const double range_a = depths.a * baseline_m, range_b = depths.b * baseline_m;
  if (range_a < kNearest_m || range_b < kNearest_m) return std::nullopt;
  const bool is_in_a = IsOn(range_a, a.surface_m) && range_b > b.surface_m + kBeyond_m;
  const bool is_in_b = IsOn(range_b, b.surface_m) && range_a > a.surface_m + kBeyond_m;
  if (is_in_a == is_in_b || !FitSizes(a.log_size, b.log_size, range_b / range_a)) {
    return std::nullopt;
  }
  const Vector3d own_wall_a = pair.a.position + a.surface_m * a.ray;
  const Vector3d own_wall_b = transform * (pair.b.position + b.surface_m * b.ray);
  Sight sight;
  sight.match = match;
  sight.door = (is_in_a ? own_wall_b : own_wall_a).head<2>();
  const Vector3d seen = (is_in_a ? own_wall_a : own_wall_b) / kSpot_m;
  for (int k = 0; k < 3; ++k) sight.spot[static_cast<size_t>(k)] = std::lround(seen[k]);
  return sight;
}

int CountSpots(const std::vector<Sight>& sights, const Vector2d& door) {
  std::set<std::array<long, 3>> spots;
  for (const Sight& sight : sights) {
    if ((sight.door - door).norm() < kHalfDoor_m) spots.insert(sight.spot);
  }
  return static_cast<int>(spots.size());
}

}  // namespace

DoorSight LookThroughDoor(std::span<const ViewPairMatches> pairs, const Placement& placement,
                          double bound_rad, int roll) {
  const Rigid3 transform = placement.Transform();
  std::vector<Sight> sights;
  for (size_t p = 0; p < pairs.size(); ++p) {
    const ViewPairMatches& pair = pairs[p];
    const size_t count = pair.matches.size();
    const Vector3d baseline = transform * pair.b.position - pair.a.position;
    const double length_m = baseline.norm();
    if (length_m < kNearest_m) continue;
    const TwoViewGeometry geometry{transform.rotation, baseline / length_m};
    const size_t offset = roll > 0 ? 1 + static_cast<size_t>(roll) * count / 23 : 0;
    for (size_t i = 0; i < count; ++i) {
      std::optional<Sight> sight = SightOf(pair, i, pair.rays_b[(i + offset) % count], transform,
                                           geometry, length_m, bound_rad);
      if (!sight) continue;
      sight->pair = p;
      sights.push_back(*sight);
    }
  }
  DoorSight best;
  Vector2d door = Vector2d::Zero();
  for (const Sight& sight : sights) {
    const int num_spots = CountSpots(sights, sight.door);
    if (num_spots <= best.num_spots) continue;
    best.num_spots = num_spots;
    door = sight.door;
  }
  best.inliers.resize(pairs.size());
  for (const Sight& sight : sights) {
    if ((sight.door - door).norm() < kHalfDoor_m) best.inliers[sight.pair].push_back(sight.match);
  }
  return best;
}

std::vector<Vector2d> ShiftsOf(const ViewPairMatches& pair, size_t match, double yaw_rad) {
  const RoomRay &a = pair.rays_a[match], &b = pair.rays_b[match];
  const Eigen::Matrix3d turn = RotationZ(yaw_rad);
  const Vector3d ray_b = turn * b.ray, position_b = turn * pair.b.position;
  std::vector<Vector2d> shifts;
  const auto add = [&](double range_a, double range_b) {
    if (range_a > kFarthest_m || range_b > kFarthest_m) return;
    if (!FitSizes(a.log_size, b.log_size, range_b / range_a)) return;
    const Vector3d shift = pair.a.position + range_a * a.ray - position_b - range_b * ray_b;
    shifts.emplace_back(shift.head<2>());
  };
  // What is seen has one height for both: that gives the other ray's length.
  const double rise = pair.b.position.z() - pair.a.position.z();
  if (!IsLevel(ray_b)) {
    const double range_b = (a.surface_m * a.ray.z() - rise) / ray_b.z();
    if (range_b > std::max(b.surface_m, kNearest_m)) add(a.surface_m, range_b);
  }
  if (!IsLevel(a.ray)) {
    const double range_a = (b.surface_m * ray_b.z() + rise) / a.ray.z();
    if (range_a > std::max(a.surface_m, kNearest_m)) add(range_a, b.surface_m);
  }
  return shifts;
}

}  // namespace enfilade
