// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/slide.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/floorplan/box_index.h"
#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinGap_m = 0.05;  // between rings, and between the two faces of a wall
constexpr double kShortestEdge_m = 1e-3;
constexpr double kSquare = 1e-6;          // cosines nearer to 1 are those of a right angle
constexpr double kMinMeetingSine = 0.15;  // lines at smaller angles meet nowhere sure

struct Edge {
  size_t polygon, ring, index;  // ring 0 is the outer one
  Vector2d a, b;                // before the slide
  std::optional<Vector2d> shift;

  [[nodiscard]] Vector2d Direction() const { return (b - a).normalized(); }
  [[nodiscard]] Vector2d Normal() const {
    return {-Direction().y(), Direction().x()};
  }  // into the room
  [[nodiscard]] double Length() const { return (b - a).norm(); }
};

Ring2& RingOf(Polygon2& polygon, size_t ring) {
  return ring == 0 ? polygon.outer : polygon.holes[ring - 1];
}
const Ring2& RingOf(const Polygon2& polygon, size_t ring) {
  return ring == 0 ? polygon.outer : polygon.holes[ring - 1];
}

std::vector<Edge> MeasureEdges(const LoopField& field, double reach_m,
                               std::vector<Polygon2>& polygons) {
  std::vector<Edge> edges;
  for (size_t p = 0; p < polygons.size(); ++p) {
    for (size_t r = 0; r <= polygons[p].holes.size(); ++r) {
      const Ring2& ring = RingOf(polygons[p], r);
      for (size_t i = 0; i < ring.size(); ++i) {
        Edge edge{p, r, i, ring[i], ring[(i + 1) % ring.size()], {}};
        const WallBand band = MeasureWallBand(field, edge.a, edge.b, reach_m);
        if (band.has_peak) edge.shift = band.offset_m * edge.Normal();
        edges.push_back(edge);
      }
    }
  }
  return edges;
}

/// Two edges that look away from each other, side by side, and would meet: neither moves.
void CancelCollapses(std::vector<Edge>& edges) {
  const std::vector<Edge> all = edges;
  const auto shift_of = [](const Edge& edge) { return edge.shift.value_or(Vector2d::Zero()); };
  std::vector<Box2> boxes;
  double longest_shift_m = 0;
  for (const Edge& edge : all) {
    boxes.push_back(Grown(BoxOf(edge.a, edge.b), AsideOf(edge.Length())));
    longest_shift_m = std::max(longest_shift_m, shift_of(edge).norm());
  }
  const BoxIndex index(boxes);
  const double reach_m = kMinGap_m + 2 * longest_shift_m;
  for (size_t i = 0; i < all.size(); ++i) {
    for (const size_t j : index.Touching(Grown(BoxOf(all[i].a, all[i].b), reach_m))) {
      const Vector2d along = all[i].Direction(), normal = all[i].Normal();
      if (along.dot(all[j].Direction()) > -0.99) continue;
      const double from = std::max(0.0, along.dot(all[j].b - all[i].a));
      const double to = std::min(all[i].Length(), along.dot(all[j].a - all[i].a));
      if (to - from < kMinGap_m) continue;
      const double gap = normal.dot(all[i].a - all[j].a);
      const double new_gap = gap + normal.dot(shift_of(all[i]) - shift_of(all[j]));
      if (gap > 0 && new_gap < std::min(gap, kMinGap_m)) edges[i].shift.reset();
    }
  }
}

bool RingsTouch(const Ring2& a, const Ring2& b) {
  for (const Vector2d& p : a) {
    for (size_t i = 0; i < b.size(); ++i) {
      if (DistanceToSegment(p, b[i], b[(i + 1) % b.size()]) < kMinGap_m) return true;
    }
  }
  return false;
}

/// Where an edge's end `v` comes to when the edge moves by `shift`, along its normal, and the
/// neighbour that it shares the end with stays on its line; none where the two hardly part.
std::optional<Vector2d> ShiftedEnd(const Vector2d& v, const Vector2d& neighbour,
                                   const Vector2d& shift) {
  const double distance_m = shift.norm(), along_m = neighbour.normalized().dot(shift);
  if (std::abs(along_m) >= (1 - kSquare) * distance_m) return v + shift;
  if (std::abs(along_m) < kMinMeetingSine * distance_m) return std::nullopt;
  return v + distance_m * distance_m / along_m * neighbour.normalized();
}

/// The part of the jog that lies across the walls beside it.
Vector2d Across(const Vector2d& jog, const Vector2d& wall) {
  const double along_m = jog.dot(wall.normalized());
  return std::abs(along_m) <= kSquare * jog.norm() ? jog : jog - along_m * wall.normalized();
}

/// Moves one edge unless it or a neighbour would turn round or the polygon would break.
bool MoveEdge(Polygon2& polygon, size_t ring_idx, size_t i, const Vector2d& shift) {
  Ring2& ring = RingOf(polygon, ring_idx);
  const size_t n = ring.size(), j = (i + 1) % n;
  const Vector2d before = ring[(i + n - 1) % n], after = ring[(j + 1) % n];
  const Vector2d old_i = ring[i], old_j = ring[j];
  const std::optional<Vector2d> new_i = ShiftedEnd(old_i, old_i - before, shift),
                                new_j = ShiftedEnd(old_j, after - old_j, shift);
  if (!new_i || !new_j) return false;
  const auto keeps_direction = [](const Vector2d& old_edge, const Vector2d& new_edge) {
    return old_edge.dot(new_edge) > 0 && new_edge.norm() > kShortestEdge_m;
  };
  if (!keeps_direction(old_i - before, *new_i - before) ||
      !keeps_direction(old_j - old_i, *new_j - *new_i) ||
      !keeps_direction(after - old_j, after - *new_j))
    return false;
  ring[i] = *new_i;
  ring[j] = *new_j;
  if (IsValidRing(polygon, ring_idx)) return true;
  ring[i] = old_i;
  ring[j] = old_j;
  return false;
}

/// Puts the two parallel walls beside the jog i on the line of the one that weighs more; the jog
/// vanishes.
bool StraightenJog(const WallWeight& weight, Polygon2& polygon, size_t ring_idx, size_t i) {
  Ring2& ring = RingOf(polygon, ring_idx);
  const Ring2 old = ring;
  const size_t n = ring.size(), j = (i + 1) % n;
  if (n <= 4) return false;
  const Vector2d jog = ring[j] - ring[i];
  const size_t before = (i + n - 1) % n, after = (j + 1) % n;
  const Vector2d in = ring[i] - ring[before], out = ring[after] - ring[j];
  // Else it is the end of a thin wall or a niche, or the walls belong to an angle.
  if (in.normalized().dot(out.normalized()) < 1 - kSquare) return false;
  const bool keeps_first = weight(ring[before], ring[i]) >= weight(ring[j], ring[after]);
  const size_t moved = keeps_first ? after : before;
  const Vector2d beyond = ring[keeps_first ? (after + 1) % n : (before + n - 1) % n];
  const std::optional<Vector2d> end =
      ShiftedEnd(ring[moved], beyond - ring[moved], Across(jog, out) * (keeps_first ? -1 : 1));
  if (!end) return false;
  ring[moved] = *end;
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)));
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)));
  if (IsSimple(ring) && IsValidRing(polygon, ring_idx)) return true;
  ring = old;
  return false;
}

}  // namespace

bool IsValidRing(const Polygon2& polygon, size_t ring_idx) {
  const Ring2& ring = RingOf(polygon, ring_idx);
  if (!IsSimple(ring)) return false;
  if (ring_idx > 0 && !Contains(polygon.outer, ring[0])) return false;
  for (size_t k = 0; k <= polygon.holes.size(); ++k) {
    if (k == ring_idx) continue;
    const Ring2& other = RingOf(polygon, k);
    if (RingsTouch(ring, other) || RingsTouch(other, ring)) return false;
  }
  return true;
}

double LengthOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (b - a).norm(); }

void StraightenJogs(double min_jog_m, const WallWeight& weight, Polygon2& polygon) {
  for (size_t r = 0; r <= polygon.holes.size(); ++r) {
    for (size_t i = 0; i < RingOf(polygon, r).size();) {
      const Ring2& ring = RingOf(polygon, r);
      const bool is_jog = (ring[(i + 1) % ring.size()] - ring[i]).norm() < min_jog_m;
      i = is_jog && StraightenJog(weight, polygon, r, i) ? 0 : i + 1;
    }
  }
}

int SlideToEvidence(const LoopField& field, double reach_m, double min_jog_m,
                    std::vector<Polygon2>& polygons) {
  std::vector<Edge> edges = MeasureEdges(field, reach_m, polygons);
  CancelCollapses(edges);
  // Long walls are surest: they move first, short ones where they still can.
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.Length() > b.Length(); });
  int num_moved = 0;
  for (const Edge& edge : edges) {
    if (edge.shift)
      num_moved += MoveEdge(polygons[edge.polygon], edge.ring, edge.index, *edge.shift);
  }
  for (Polygon2& polygon : polygons) StraightenJogs(min_jog_m, LengthOf, polygon);
  return num_moved;
}

}  // namespace enfilade
