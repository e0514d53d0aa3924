// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/join_rooms.h"

#include <algorithm>
#include <optional>

#include "enfilade/geometry/boolean.h"
#include "src/floorplan/box_index.h"
#include "src/floorplan/sound_polygon.h"
#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kThickestGap_m = 0.35;
constexpr double kNarrowestWay_m = 0.6;
// Of both edges. A door leaves wall on one side of it: a closet is no part of the room before it.
constexpr double kMinShare = 0.9;
constexpr double kParallel = 0.99;    // cosine
constexpr double kOverlap_m = 0.005;  // of the gap and the rooms, so that they join
constexpr double kCollinear_m = 1e-6;

bool IsSeen(const LoopField& field, const Vector2d& a, const Vector2d& b, double reach_m) {
  return MeasureWallBand(field, a, b, reach_m).seen_share >= kPartlySeenShare;
}

// The gap between the edges a → b and c → d of two rooms, if they look at each other end to end and
// neither shows a wall.
std::optional<Polygon2> Gap(const LoopField& field, double reach_m, const Vector2d& a,
                            const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double length = (b - a).norm();
  const Vector2d along = (b - a) / length, outward(along.y(), -along.x());
  if (along.dot((d - c).normalized()) > -kParallel) return std::nullopt;
  const double gap = outward.dot(c - a);
  const double from = std::max(0.0, along.dot(d - a)), to = std::min(length, along.dot(c - a));
  const double least = std::max(kNarrowestWay_m, kMinShare * std::max(length, (d - c).norm()));
  if (gap < 0 || gap > kThickestGap_m || to - from < least) return std::nullopt;
  if (IsSeen(field, a, b, reach_m) || IsSeen(field, c, d, reach_m)) return std::nullopt;
  const Vector2d near_a = a + from * along, near_b = a + to * along;
  const Vector2d across = (gap + kOverlap_m) * outward, over = kOverlap_m * outward;
  return Polygon2{{near_a - over, near_a + across, near_b + across, near_b - over}, {}};
}

std::optional<Polygon2> GapBetween(const LoopField& field, double reach_m, const Ring2& ring,
                                   const Ring2& other) {
  for (size_t i = 0; i < ring.size(); ++i) {
    for (size_t j = 0; j < other.size(); ++j) {
      const std::optional<Polygon2> between =
          Gap(field, reach_m, ring[i], ring[(i + 1) % ring.size()], other[j],
              other[(j + 1) % other.size()]);
      if (between) return between;
    }
  }
  return std::nullopt;
}

}  // namespace

MultiPolygon2 FindUnseenWalls(const LoopField& field, double reach_m, size_t num_entered,
                              const std::vector<Polygon2>& rooms) {
  MultiPolygon2 gaps;
  std::vector<Box2> boxes;
  for (size_t i = 0; i < num_entered; ++i)
    boxes.push_back(Grown(BoxOf(rooms[i].outer), kThickestGap_m));
  const BoxIndex index(boxes);
  for (size_t i = 0; i < num_entered; ++i) {
    for (const size_t j : index.Touching(boxes[i])) {
      if (j <= i) continue;
      const std::optional<Polygon2> gap =
          GapBetween(field, reach_m, rooms[i].outer, rooms[j].outer);
      if (gap) gaps.push_back(*gap);
    }
  }
  return gaps;
}

int JoinAcross(const MultiPolygon2& gaps, std::vector<Polygon2>& rooms) {
  int num_joins = 0;
  for (const Polygon2& gap : gaps) {
    std::vector<size_t> beside;
    const Box2 bounds = BoxOf(gap.outer);
    for (size_t i = 0; i < rooms.size(); ++i) {
      if (!BoxOf(rooms[i].outer).intersects(bounds)) continue;
      if (Area(Intersection({rooms[i]}, {gap})) > 0) beside.push_back(i);
    }
    if (beside.size() != 2) continue;
    rooms[beside[0]] = LargestRoom(Union({rooms[beside[0]], rooms[beside[1]], gap}), kCollinear_m);
    rooms.erase(rooms.begin() + static_cast<std::ptrdiff_t>(beside[1]));
    ++num_joins;
  }
  return num_joins;
}

}  // namespace enfilade
