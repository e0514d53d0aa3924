// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/necks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "enfilade/geometry/cross.h"
#include "src/floorplan/closet.h"
#include "src/floorplan/sound_polygon.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinTurn = 0.2;    // sine of the angle by which a wall's corner juts into the room
constexpr double kStraight = 0.99;  // cosine
constexpr double kSquare = 0.15;    // cosine
constexpr double kMinBeside_m = 0.1;  // of the wall beside a neck
constexpr double kMinFace_m = 0.3;    // of a wall that ends in the room
constexpr double kTouch_m = 1e-6, kClear_m = 1e-3;
constexpr double kCollinear_m = 1e-6;

// Corners that point into the room.
std::vector<bool> JuttingCorners(const Ring2& ring) {
  const size_t n = ring.size();
  std::vector<bool> juts(n);
  for (size_t i = 0; i < n; ++i) {
    const Vector2d in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
    juts[i] = Cross(in.normalized(), out.normalized()) < -kMinTurn;
  }
  return juts;
}

// Whether the segment from `a` to `b`, both on the boundary, runs inside the room.
bool RunsInside(const Polygon2& room, const Vector2d& a, const Vector2d& b) {
  const Vector2d middle = 0.5 * (a + b), direction = (b - a).normalized();
  if (!Contains(room, middle)) return false;
  const double half_m = 0.5 * (b - a).norm() - kTouch_m;
  const std::vector<Ring2> rings = RingsOf(room);
  return std::all_of(rings.begin(), rings.end(), [&](const Ring2& ring) {
    const bool is_touched = std::any_of(ring.begin(), ring.end(), [&](const Vector2d& p) {
      return p != a && p != b && DistanceToSegment(p, a, b) < kClear_m;
    });
    return !is_touched && RayDistance(ring, middle, direction) >= half_m &&
           RayDistance(ring, middle, -direction) >= half_m;
  });
}

// The outer ring from vertex `from` round to vertex `to`, and the holes in it.
Polygon2 Side(const Polygon2& room, size_t from, size_t to) {
  Polygon2 side;
  for (size_t i = from;; i = (i + 1) % room.outer.size()) {
    side.outer.push_back(room.outer[i]);
    if (i == to) break;
  }
  for (const Ring2& hole : room.holes) {
    if (Contains(side.outer, hole.front())) side.holes.push_back(hole);
  }
  return side;
}

// Whether the edge that closes the ring lies in a straight wall.
bool IsInStraightWall(const Ring2& ring) {
  const Vector2d before = ring.back() - ring[ring.size() - 2], after = ring[1] - ring.front();
  const Vector2d along = (ring.front() - ring.back()).normalized();
  const auto goes_on = [&](const Vector2d& wall) {
    return wall.norm() > kMinBeside_m && along.dot(wall.normalized()) > kStraight;
  };
  const auto is_corner = [&](const Vector2d& wall, double left_turn) {
    return left_turn > 0 && std::abs(along.dot(wall.normalized())) < kSquare;
  };
  if (goes_on(before)) return goes_on(after) || is_corner(after, Cross(along, after));
  return goes_on(after) && is_corner(before, Cross(before, along));
}

class NeckFinder {
 public:
  NeckFinder(const Polygon2& room, const std::vector<Vector2d>& cameras, double max_length_m,
             double min_area_m2)
      : room_(room),
        cameras_(cameras),
        max_length_m_(max_length_m),
        min_area_m2_(min_area_m2),
        juts_(JuttingCorners(room.outer)) {}

  [[nodiscard]] std::vector<Neck> Find() const {
    std::vector<Neck> necks;
    const size_t n = room_.outer.size();
    for (size_t i = 0; i < n; ++i) {
      if (!juts_[i]) continue;
      for (size_t j = i + 2; j < n; ++j) {
        if (juts_[j] && (i > 0 || j + 1 < n)) AddNeck(room_, i, j, necks);
      }
      if (EndsAWall(i + n - 1, i, i + 1, i + 2)) AddProlonged(i, i + n - 1, necks);
      if (EndsAWall(i + 1, i, i + n - 1, i + n - 2)) AddProlonged(i, i + 1, necks);
    }
    return necks;
  }

 private:
  [[nodiscard]] const Vector2d& At(size_t i) const { return room_.outer[i % room_.outer.size()]; }

  // Whether the corners i and k beside each other are those of a wall that ends in the room, its
  // faces running from corner `before` to i and from k to `after`: a jog beside a corner is none.
  [[nodiscard]] bool EndsAWall(size_t before, size_t i, size_t k, size_t after) const {
    return juts_[k % juts_.size()] && (At(i) - At(k)).norm() <= kThickestWall_m &&
           std::min((At(i) - At(before)).norm(), (At(after) - At(k)).norm()) >= kMinFace_m;
  }

  // Prolongs the wall face from corner `before` to corner i until it meets a wall.
  void AddProlonged(size_t i, size_t before, std::vector<Neck>& necks) const {
    const Ring2& ring = room_.outer;
    const Vector2d from = At(i), direction = (from - At(before)).normalized();
    double nearest_m = std::numeric_limits<double>::infinity();
    std::optional<size_t> edge;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vector2d p = ring[k] - from, along = At(k + 1) - ring[k];
      const double across = Cross(direction, along);
      if (std::abs(across) < kTouch_m) continue;
      const double distance_m = Cross(p, along) / across, share = Cross(p, direction) / across;
      if (share < 0 || share > 1 || distance_m < kTouch_m || distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      edge = k;
    }
    if (!edge || nearest_m > max_length_m_) return;
    const Vector2d end = from + nearest_m * direction;
    if ((end - ring[*edge]).norm() < kTouch_m || (end - At(*edge + 1)).norm() < kTouch_m) return;
    Polygon2 room = room_;
    room.outer.insert(room.outer.begin() + static_cast<std::ptrdiff_t>(*edge + 1), end);
    const size_t start = i > *edge ? i + 1 : i;
    AddNeck(room, std::min(start, *edge + 1), std::max(start, *edge + 1), necks);
  }

  // Adds the line between the vertices i < j of the room if it is a neck.
  void AddNeck(const Polygon2& room, size_t i, size_t j, std::vector<Neck>& necks) const {
    const Vector2d &p = room.outer[i], &q = room.outer[j];
    if ((q - p).norm() > max_length_m_ || !RunsInside(room, p, q)) return;
    Neck neck{q, p, Side(room, j, i), Side(room, i, j)};
    const bool is_before = HasCamera(neck.near), is_beyond = HasCamera(neck.beyond);
    if (is_before == is_beyond) return;
    if (is_beyond) {
      std::swap(neck.a, neck.b);
      std::swap(neck.near, neck.beyond);
    }
    neck.is_near_straight = IsInStraightWall(neck.near.outer);
    neck.is_beyond_straight = IsInStraightWall(neck.beyond.outer);
    if (!neck.is_near_straight && !neck.is_beyond_straight) return;
    if (Area(neck.near) < min_area_m2_ || Area(neck.beyond) < min_area_m2_) return;
    // The neck is the edge that closes the ring of either side.
    std::rotate(neck.beyond.outer.rbegin(), neck.beyond.outer.rbegin() + 1,
                neck.beyond.outer.rend());
    neck.near = WithoutCollinear(std::move(neck.near), kCollinear_m);
    necks.push_back(std::move(neck));
  }

  [[nodiscard]] bool HasCamera(const Polygon2& side) const {
    return std::any_of(cameras_.begin(), cameras_.end(),
                       [&](const Vector2d& camera) { return Contains(side, camera); });
  }

  const Polygon2& room_;
  const std::vector<Vector2d>& cameras_;
  double max_length_m_, min_area_m2_;
  std::vector<bool> juts_;
};

}  // namespace

std::vector<std::pair<Vector2d, Vector2d>> WallsBeyond(const Neck& neck) {
  std::vector<std::pair<Vector2d, Vector2d>> walls;
  for (const Ring2& ring : RingsOf(neck.beyond)) {
    for (size_t i = 0; i < ring.size(); ++i)
      walls.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  }
  walls.erase(walls.begin());
  return walls;
}

std::vector<Neck> FindNecks(const Polygon2& room, const std::vector<Vector2d>& cameras,
                            double max_length_m, double min_area_m2) {
  return NeckFinder(room, cameras, max_length_m, min_area_m2).Find();
}

}  // namespace enfilade
