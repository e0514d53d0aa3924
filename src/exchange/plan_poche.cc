// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/plan_poche.h"

#include <algorithm>
#include <cmath>

#include "enfilade/floorplan/wall_lookup.h"
#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// A mitre longer than this many wall thicknesses is cut off: the corner is too sharp.
constexpr double kMitreLimit = 3;
// Wall faces of two rooms farther apart than this do not belong to one wall.
constexpr double kMaxWall_m = 0.6;

struct Edge {
  Vector2d a, b;
  Vector2d outward;  // unit
  const Wall* wall = nullptr;
  [[nodiscard]] double thickness_m() const { return wall != nullptr ? wall->thickness_m : 0; }
};

std::vector<Edge> EdgesOf(const Storey& storey, int room_id, const Ring2& ring) {
  std::vector<Edge> edges;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % ring.size()];
    const Vector2d along = (b - a).normalized();
    edges.push_back({a, b, {along.y(), -along.x()}, FindWallOfEdge(storey, room_id, a, b)});
  }
  return edges;
}

// From the corner that two edges share to where the outer faces meet, as seen from `self`: the x
// with x · n = thickness for both.
Vector2d MitreOffset(const Edge& self, const Edge& other) {
  const Vector2d square = self.thickness_m() * self.outward;
  Eigen::Matrix2d normals;
  normals << self.outward.transpose(), other.outward.transpose();
  if (std::abs(normals.determinant()) < 1e-6) return square;
  const Vector2d mitre = normals.inverse() * Vector2d(self.thickness_m(), other.thickness_m());
  const double limit_m = kMitreLimit * std::max(self.thickness_m(), other.thickness_m());
  return mitre.norm() <= limit_m ? mitre : square;
}

void AppendBodies(const Storey& storey, const Room& room, const Ring2& ring, WallBodies& bodies) {
  const std::vector<Edge> edges = EdgesOf(storey, room.id, ring);
  for (size_t i = 0; i < edges.size(); ++i) {
    const Edge& edge = edges[i];
    if (edge.thickness_m() <= 0) continue;
    const Edge& previous = edges[(i + edges.size() - 1) % edges.size()];
    const Edge& next = edges[(i + 1) % edges.size()];
    const Polygon2 body{
        {edge.b, edge.a, edge.a + MitreOffset(edge, previous), edge.b + MitreOffset(edge, next)},
        {}};
    (edge.wall->seen == WallSeen::kInferred ? bodies.inferred : bodies.seen).push_back(body);
  }
}

// How deep an opening cuts: through its wall, and on to the face of the room behind it.
double OpeningDepth(const Storey& storey, const Opening& opening, const Vector2d& outward) {
  double depth_m = 0;
  for (const Wall& wall : storey.walls) {
    if (wall.id == opening.wall_id) depth_m = std::max(depth_m, wall.thickness_m);
    const Vector2d along = (wall.b - wall.a).normalized();
    if (wall.room_id != opening.other_room_id || std::abs(along.dot(outward)) > 0.1) continue;
    const double behind_m = outward.dot(0.5 * (wall.a + wall.b) - opening.a);
    const Vector2d middle = 0.5 * (opening.a + opening.b) + behind_m * outward;
    if (behind_m > 0 && behind_m < kMaxWall_m && DistanceToSegment(middle, wall.a, wall.b) < 0.05) {
      depth_m = std::max(depth_m, behind_m);
    }
  }
  return depth_m;
}

MultiPolygon2 OpeningHoles(const Storey& storey) {
  constexpr double kOverlap_m = 0.005;
  MultiPolygon2 holes;
  for (const Opening& opening : storey.openings) {
    const Ring2 ring = OpeningFootprint(storey, opening);
    if (ring.empty()) continue;
    const Vector2d over = kOverlap_m * (ring[3] - ring[0]).normalized();
    holes.push_back({{ring[0] - over, ring[1] - over, ring[2] + over, ring[3] + over}, {}});
  }
  return holes;
}

}  // namespace

Ring2 OpeningFootprint(const Storey& storey, const Opening& opening) {
  const auto wall = std::find_if(storey.walls.begin(), storey.walls.end(),
                                 [&](const Wall& w) { return w.id == opening.wall_id; });
  if (wall == storey.walls.end()) return {};
  const Vector2d along = (wall->b - wall->a).normalized();
  const Vector2d outward(along.y(), -along.x());
  const Vector2d depth = OpeningDepth(storey, opening, outward) * outward;
  return {opening.a, opening.b, opening.b + depth, opening.a + depth};
}

WallBodies BuildWallBodies(const Storey& storey) {
  WallBodies bodies;
  MultiPolygon2 kept_free = OpeningHoles(storey);
  for (const Room& room : storey.rooms) {
    AppendBodies(storey, room, room.polygon.outer, bodies);
    for (const Ring2& hole : room.polygon.holes) AppendBodies(storey, room, hole, bodies);
    kept_free.push_back(room.polygon);
  }
  bodies.seen = Difference(bodies.seen, kept_free);
  bodies.inferred = Difference(Difference(bodies.inferred, kept_free), bodies.seen);
  return bodies;
}

}  // namespace enfilade
