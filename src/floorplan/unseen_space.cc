// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/unseen_space.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "enfilade/geometry/boolean.h"
#include "src/floorplan/box_index.h"
#include "src/floorplan/closet.h"
#include "src/floorplan/sound_polygon.h"
#include "src/floorplan/tidy_room.h"
#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinSpace_m2 = 0.5;
constexpr double kOpenSide_m = 0.6;  // as much of a boundary without wall is a way in
constexpr double kTouch_m = 0.01;
constexpr double kCollinear_m = 1e-6;

// The rooms and all that they enclose.
MultiPolygon2 Enclosed(const MultiPolygon2& rooms, double gap_m, double max_hole_m2) {
  MultiPolygon2 closed = OffsetSharp(OffsetSharp(rooms, 0.5 * gap_m), -0.5 * gap_m);
  for (Polygon2& polygon : closed) {
    std::erase_if(polygon.holes,
                  [&](const Ring2& hole) { return -SignedArea(hole) <= max_hole_m2; });
  }
  return Union(closed, rooms);
}

// How far a room borders on a space, and how far without a wall that somebody saw.
struct Border {
  size_t room = 0;
  double length_m = 0, open_m = 0;
};

class SpaceTaker {
 public:
  SpaceTaker(const LoopField& field, const FloorplanOptions& options, std::vector<Polygon2>& rooms)
      : field_(field), options_(options), rooms_(rooms) {}

  // Returns the area taken in.
  double Take(const Polygon2& space) {
    FindNear(space);
    if (near_.empty()) return 0;
    const MultiPolygon2 reach = OffsetSharp({space}, kTouch_m);
    std::vector<Border> borders;
    for (const size_t room : near_) borders.push_back(BorderOn(room, reach));
    const auto most_open =
        std::max_element(borders.begin(), borders.end(),
                         [](const Border& a, const Border& b) { return a.open_m < b.open_m; });
    const bool is_cut_off = most_open->open_m >= kOpenSide_m;
    if (!is_cut_off) {
      const Polygon2 closet =
          TidyRoom(OpenSharp(Difference({space}, Walls(std::nullopt)), kClosetDepth_m),
                   options_.min_jog_m, LengthOf, std::nullopt, rooms_);
      if (Area(closet) >= kClosetArea_m2) {
        rooms_.push_back(closet);
        return Area(closet);
      }
    }
    return WidenARoom(reach, borders, is_cut_off);
  }

 private:
  void FindNear(const Polygon2& space) {
    near_.clear();
    const double reach_m = options_.wall_thickness_m + 2 * kTouch_m;
    const Box2 bounds = BoxOf(space.outer);
    for (size_t i = 0; i < rooms_.size(); ++i) {
      if (bounds.exteriorDistance(BoxOf(rooms_[i].outer)) <= reach_m) near_.push_back(i);
    }
  }

  [[nodiscard]] Border BorderOn(size_t room, const MultiPolygon2& reach) const {
    Border border{room};
    for (const Ring2& ring : RingsOf(rooms_[room])) {
      for (size_t i = 0; i < ring.size(); ++i)
        AddEdge(ring[i], ring[(i + 1) % ring.size()], reach, border);
    }
    return border;
  }

  // Adds what of the edge a → b lies along the space.
  void AddEdge(const Vector2d& a, const Vector2d& b, const MultiPolygon2& reach,
               Border& border) const {
    const double length_m = (b - a).norm(), step_m = field_.frame.cell_m;
    const int num_steps = std::max(1, static_cast<int>(length_m / step_m));
    std::optional<int> begin;
    for (int k = 0; k <= num_steps; ++k) {
      const bool is_along =
          k < num_steps && std::any_of(reach.begin(), reach.end(), [&](const Polygon2& part) {
            return Contains(part, a + (k + 0.5) / num_steps * (b - a));
          });
      if (is_along && !begin) begin = k;
      if (is_along || !begin) continue;
      const Vector2d from = a + static_cast<double>(*begin) / num_steps * (b - a);
      const Vector2d to = a + static_cast<double>(k) / num_steps * (b - a);
      const double along_m = (to - from).norm();
      border.length_m += along_m;
      if (MeasureWallBand(field_, from, to, options_.slide_m).seen_share < kPartlySeenShare)
        border.open_m += along_m;
      begin.reset();
    }
  }

  // The rooms near the space but one, with their walls.
  [[nodiscard]] MultiPolygon2 Walls(std::optional<size_t> without) const {
    MultiPolygon2 others;
    for (const size_t i : near_) {
      if (i != without) others.push_back(rooms_[i]);
    }
    return OffsetSharp(others, options_.wall_thickness_m);
  }

  // Where both go on side by side, the room's own walls say where.
  [[nodiscard]] Polygon2 Widened(size_t room_idx, const MultiPolygon2& by) const {
    const Polygon2& room = rooms_[room_idx];
    const std::vector<Ring2> rings = RingsOf(room);
    const auto weight = [&](const Vector2d& a, const Vector2d& b) {
      const Vector2d middle = 0.5 * (a + b);
      const bool is_own = std::any_of(rings.begin(), rings.end(), [&](const Ring2& ring) {
        return DistanceToRing(ring, middle) < kCollinear_m;
      });
      return is_own ? LengthOf(a, b) : 0;
    };
    return TidyRoom(Union({room}, by), options_.min_jog_m, weight, room_idx, rooms_);
  }

  // Adds the space to the room that is most open to it, or else gets the fewest vertices.
  double WidenARoom(const MultiPolygon2& reach, const std::vector<Border>& borders,
                    bool is_cut_off) {
    std::optional<size_t> best_room;
    Polygon2 best;
    std::tuple<double, int, double> best_cost;
    for (const Border& border : borders) {
      if (border.length_m < kThickestWall_m) continue;
      const Polygon2& room = rooms_[border.room];
      const Polygon2 wider = Widened(border.room, Difference(reach, Walls(border.room)));
      if (Area(wider) < Area(room) + 0.5 * kMinSpace_m2) continue;
      const std::tuple<double, int, double> cost{is_cut_off ? -border.open_m : 0.0,
                                                 NumVertices(wider) - NumVertices(room),
                                                 -border.length_m};
      if (best_room && cost >= best_cost) continue;
      best_room = border.room;
      best = wider;
      best_cost = cost;
    }
    if (!best_room) return 0;
    const double gained_m2 = Area(best) - Area(rooms_[*best_room]);
    rooms_[*best_room] = best;
    return gained_m2;
  }

  const LoopField& field_;
  const FloorplanOptions& options_;
  std::vector<Polygon2>& rooms_;
  std::vector<size_t> near_;  ///< rooms that the space may border on
};

}  // namespace

double TakeInUnseenSpace(const LoopField& field, const FloorplanOptions& options,
                         std::vector<Polygon2>& rooms) {
  if (rooms.empty() || options.unseen_gap_m <= 0) return 0;
  MultiPolygon2 outlines, seen;
  for (const Polygon2& room : rooms) {
    outlines.push_back({room.outer, {}});
    // What stands in a room or juts into it was seen all round: columns, chimneys.
    const MultiPolygon2 filled = Enclosed({outlines.back()}, options.unseen_gap_m, 0);
    seen.insert(seen.end(), filled.begin(), filled.end());
  }
  const MultiPolygon2 home = Enclosed(outlines, options.unseen_gap_m, options.unseen_hole_m2);
  MultiPolygon2 spaces = OpenSharp(Difference(home, seen), kThickestWall_m);
  std::erase_if(spaces, [](const Polygon2& space) { return Area(space) < kMinSpace_m2; });
  std::stable_sort(spaces.begin(), spaces.end(),
                   [](const Polygon2& a, const Polygon2& b) { return Area(a) > Area(b); });
  SpaceTaker taker(field, options, rooms);
  double area_m2 = 0;
  for (const Polygon2& space : spaces) area_m2 += taker.Take(space);
  return area_m2;
}

}  // namespace enfilade
