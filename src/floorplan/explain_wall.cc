// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/explain_wall.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/cross.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/outline_cost.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPointReach_m = 0.1;
constexpr double kBehindReach_m = 1;
constexpr double kFarthest_m = 1.5;  // that a wall is moved
constexpr double kVanished_m = 0.01;

Vector2d Inward(const Wall& wall) {
  const Vector2d along = (wall.b - wall.a).normalized();
  return {-along.y(), along.x()};
}

int CountPoints(const Scene& scene, const Structure& structure, const Room& room,
                const Wall& wall) {
  const double length = (wall.b - wall.a).norm();
  const Vector2d along = (wall.b - wall.a) / length, inward = Inward(wall);
  return static_cast<int>(
      std::count_if(scene.points.begin(), scene.points.end(), [&](const ScenePoint& point) {
        const Vector3d p = structure.home_from_world * point.position;
        const Vector2d from_a = p.head<2>() - wall.a;
        return p.z() > room.floor_z && p.z() < room.ceiling_z && along.dot(from_a) > 0 &&
               along.dot(from_a) < length && std::abs(inward.dot(from_a)) < kPointReach_m;
      }));
}

std::optional<WallBehind> FindBehind(const Storey& storey, const Wall& wall) {
  const double length = (wall.b - wall.a).norm();
  const Vector2d along = (wall.b - wall.a) / length, inward = Inward(wall);
  std::optional<WallBehind> nearest;
  for (const Wall& other : storey.walls) {
    if (along.dot((other.b - other.a).normalized()) > -0.98) continue;
    const double gap = -inward.dot(0.5 * (other.a + other.b) - wall.a);
    const double from = std::max(0.0, along.dot(other.b - wall.a));
    const double to = std::min(length, along.dot(other.a - wall.a));
    if (gap <= 0 || gap > kBehindReach_m || to - from < 0.3 * length) continue;
    if (!nearest || gap < nearest->gap_m) nearest = {other.id, other.room_id, gap};
  }
  return nearest;
}

// A wall between the two beside it: the corners p0 p1 p2 p3 of its ring, the wall from p1 to p2.
struct WallInRing {
  Vector2d p0, p1, p2, p3;
};

std::optional<WallInRing> FindInRing(const Room& room, const Wall& wall) {
  for (const Ring2& ring : RingsOf(room.polygon)) {
    const size_t n = ring.size();
    for (size_t i = 0; i < n && n >= 4; ++i) {
      const Vector2d &a = ring[i], &b = ring[(i + 1) % n];
      if ((a - wall.a).norm() < kVanished_m && (b - wall.b).norm() < kVanished_m)
        return WallInRing{ring[(i + n - 1) % n], a, b, ring[(i + 2) % n]};
    }
  }
  return std::nullopt;
}

// The ring's part with the wall moved outwards; none when a wall beside it would turn round.
std::optional<WallInRing> Moved(const WallInRing& ring, double outwards_m) {
  const Vector2d along = (ring.p2 - ring.p1).normalized();
  const Vector2d outward(along.y(), -along.x());
  const auto corner = [&](const Vector2d& fixed, const Vector2d& end) {
    const Vector2d beside = end - fixed;
    const double slope = outward.dot(beside.normalized());
    return Vector2d(end + outwards_m / slope * beside.normalized());
  };
  const WallInRing moved{ring.p0, corner(ring.p0, ring.p1), corner(ring.p3, ring.p2), ring.p3};
  const bool is_turned = (moved.p1 - moved.p0).dot(ring.p1 - ring.p0) < -1e-9 ||
                         (moved.p3 - moved.p2).dot(ring.p3 - ring.p2) < -1e-9 ||
                         (moved.p2 - moved.p1).dot(along) < kVanished_m;
  if (is_turned) return std::nullopt;
  return moved;
}

OutlineCost CostOf(const LoopField& field, const FloorplanOptions& options,
                   const WallInRing& ring) {
  OutlineCost cost;
  int num_corners = 4;
  for (const auto& [from, to] :
       {std::pair(ring.p0, ring.p1), std::pair(ring.p1, ring.p2), std::pair(ring.p2, ring.p3)}) {
    if ((to - from).norm() < kVanished_m) {
      num_corners -= 2;  // its neighbours are one wall
    } else {
      AddEdgeCost(field, options, from, to, cost);
    }
  }
  AddCornerCosts(options, num_corners, cost);
  return cost;
}

std::optional<NextBestWall> FindNextBest(const LoopField& field, const FloorplanOptions& options,
                                         const WallInRing& ring) {
  const Vector2d along = (ring.p2 - ring.p1).normalized();
  const Vector2d outward(along.y(), -along.x());
  // Walls that run on in one line with it cannot follow.
  for (const Vector2d& beside : {Vector2d(ring.p1 - ring.p0), Vector2d(ring.p3 - ring.p2)})
    if (std::abs(Cross(along, beside.normalized())) < 0.1) return std::nullopt;
  const double nearest_m = std::max(options.slide_m, 2 * field.frame.cell_m);
  std::vector<double> places;
  for (int k = 1; k * field.frame.cell_m <= kFarthest_m; ++k) {
    for (const int side : {1, -1}) places.push_back(side * k * field.frame.cell_m);
  }
  places.push_back(outward.dot(ring.p0 - ring.p1));  // where a wall beside it vanishes
  places.push_back(outward.dot(ring.p3 - ring.p2));
  std::optional<NextBestWall> best;
  for (const double place : places) {
    if (std::abs(place) < nearest_m || std::abs(place) > kFarthest_m) continue;
    const std::optional<WallInRing> moved = Moved(ring, place);
    if (!moved) continue;
    const OutlineCost cost = CostOf(field, options, *moved);
    if (!best || cost.total_m < best->there.total_m) best = NextBestWall{place, {}, cost};
  }
  if (best) best->here = CostOf(field, options, ring);
  return best;
}

}  // namespace

WallExplanation ExplainWall(const Scene& scene, const Structure& structure,
                            const EvidenceGrids& evidence, const FloorplanOptions& options,
                            const Floorplan& plan, int storey_idx, size_t wall_idx) {
  const Storey& storey = plan.storeys.at(static_cast<size_t>(storey_idx));
  const Wall& wall = storey.walls.at(wall_idx);
  const auto room = std::find_if(storey.rooms.begin(), storey.rooms.end(),
                                 [&](const Room& r) { return r.id == wall.room_id; });
  ENFILADE_CHECK(room != storey.rooms.end());
  auto witnesses = FindWallWitnesses(scene, structure, storey, storey_idx);
  WallExplanation why;
  why.wall = wall;
  why.storey_idx = storey_idx;
  why.sigma = FindWallSigmas(evidence, storey, witnesses, options)[wall_idx];
  why.witnesses = std::move(witnesses[wall_idx]);
  std::stable_sort(why.witnesses.begin(), why.witnesses.end(),
                   [](const WallWitness& a, const WallWitness& b) {
                     return a.sightings.size() > b.sightings.size();
                   });
  why.num_points = CountPoints(scene, structure, *room, wall);
  why.behind = FindBehind(storey, wall);
  for (const Opening& opening : storey.openings) {
    if (opening.wall_id == wall.id) why.openings.push_back(opening);
  }
  const LoopField field = MakeLoopField(evidence, options);
  AddEdgeCost(field, options, wall.a, wall.b, why.cost);
  AddCornerCosts(options, 1, why.cost);
  if (const std::optional<WallInRing> ring = FindInRing(*room, wall))
    why.next_best = FindNextBest(field, options, *ring);
  return why;
}

}  // namespace enfilade
