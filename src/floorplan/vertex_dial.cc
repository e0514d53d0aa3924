// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/vertex_dial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/floorplan/wall_lookup.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "src/floorplan/micrometres.h"
#include "src/floorplan/rooms.h"
#include "src/floorplan/wall_thickness.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kParallel = 0.985;  // cosine
constexpr double kOnWall_m = 1e-3;

// ---- Which outline each room gets.

using Curve = std::vector<OutlineChoice>;

std::vector<const Curve*> CurvesOf(const Floorplan& plan) {
  std::vector<const Curve*> curves;
  for (const Storey& storey : plan.storeys) {
    for (const Room& room : storey.rooms) {
      if (!room.curve.empty()) curves.push_back(&room.curve);
    }
  }
  return curves;
}

/// The cheapest ways to give rooms so many corners together (a knapsack with one choice a room).
class Knapsack {
 public:
  explicit Knapsack(const std::vector<const Curve*>& curves) : curves_(curves), costs_{0} {
    for (const Curve* curve : curves) {
      const auto first = static_cast<size_t>(curve->front().NumVertices());
      const size_t spread = static_cast<size_t>(curve->back().NumVertices()) - first;
      std::vector<double> costs(costs_.size() + spread, kNone);
      std::vector<uint16_t>& choices = choices_.emplace_back(costs.size(), 0);
      for (size_t c = curve->size(); c-- > 0;) {
        const OutlineChoice& outline = (*curve)[c];
        const size_t more = static_cast<size_t>(outline.NumVertices()) - first;
        for (size_t i = 0; i < costs_.size(); ++i) {
          const double cost = costs_[i] + outline.cost_m;
          if (cost >= costs[i + more]) continue;
          costs[i + more] = cost;
          choices[i + more] = static_cast<uint16_t>(c);
        }
      }
      costs_ = std::move(costs);
      least_ += static_cast<int>(first);
    }
  }

  /// Infinite where there is none.
  [[nodiscard]] double CostOf(int number) const {
    const bool is_within = number >= least_ && number - least_ < static_cast<int>(costs_.size());
    return is_within ? costs_[static_cast<size_t>(number - least_)] : kNone;
  }

  [[nodiscard]] std::vector<int> Numbers() const {
    std::vector<int> numbers;
    for (size_t i = 0; i < costs_.size() && !curves_.empty(); ++i) {
      if (costs_[i] < kNone) numbers.push_back(least_ + static_cast<int>(i));
    }
    return numbers;
  }

  /// Index into the curve of each room. There must be one.
  [[nodiscard]] std::vector<size_t> ChoicesFor(int number) const {
    std::vector<size_t> chosen(curves_.size());
    auto rest = static_cast<size_t>(number - least_);
    for (size_t r = curves_.size(); r-- > 0;) {
      const Curve& curve = *curves_[r];
      chosen[r] = choices_[r][rest];
      rest -= static_cast<size_t>(curve[chosen[r]].NumVertices() - curve.front().NumVertices());
    }
    return chosen;
  }

 private:
  const std::vector<const Curve*>& curves_;
  std::vector<std::vector<uint16_t>> choices_;  // by room, then corners of it and those before
  std::vector<double> costs_;                   // by corners of all rooms beyond the least
  int least_ = 0;
};

/// A stretch of a curve's lower convex hull.
struct HullEdge {
  double slope_m = 0;  // cost of a corner more
  int num_corners = 0;
};

std::vector<HullEdge> LowerHull(const Curve& curve) {
  std::vector<HullEdge> hull;
  for (size_t i = 1; i < curve.size(); ++i) {
    const int num = curve[i].NumVertices() - curve[i - 1].NumVertices();
    HullEdge edge{(curve[i].cost_m - curve[i - 1].cost_m) / num, num};
    while (!hull.empty() && hull.back().slope_m >= edge.slope_m) {
      const HullEdge before = hull.back();
      hull.pop_back();
      const int both = before.num_corners + edge.num_corners;
      edge = {(before.slope_m * before.num_corners + edge.slope_m * edge.num_corners) / both, both};
    }
    hull.push_back(edge);
  }
  return hull;
}

/// The least cost when rooms may mix neighbouring outlines, which is what the best Lagrange
/// multiplier for a corner gives: no choice costs less. The number must lie within the curves'.
double LinearBound(const std::vector<const Curve*>& curves, int number) {
  double cost_m = 0;
  std::vector<HullEdge> edges;
  for (const Curve* curve : curves) {
    cost_m += curve->front().cost_m;
    number -= curve->front().NumVertices();
    const std::vector<HullEdge> hull = LowerHull(*curve);
    edges.insert(edges.end(), hull.begin(), hull.end());
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const HullEdge& a, const HullEdge& b) { return a.slope_m < b.slope_m; });
  for (const HullEdge& edge : edges) {
    const int taken = std::min(number, edge.num_corners);
    cost_m += taken * edge.slope_m;
    number -= taken;
  }
  return cost_m;
}

// ---- The plan with other outlines.

void RoundStorey(Storey& storey) {
  for (Room& room : storey.rooms) {
    room.polygon = ToMicrometres(room.polygon);
    room.area_sigma_m2 = ToMicrometres(room.area_sigma_m2);
    for (OutlineChoice& outline : room.curve) {
      outline.cost_m = ToMicrometres(outline.cost_m);
      outline.polygon = ToMicrometres(outline.polygon);
      for (double& sigma_m : outline.sigma_m) sigma_m = ToMicrometres(sigma_m);
    }
  }
  for (Wall& wall : storey.walls) {
    wall.a = ToMicrometres(wall.a);
    wall.b = ToMicrometres(wall.b);
    for (double* value : {&wall.thickness_m, &wall.sigma_m, &wall.length_sigma_m})
      *value = ToMicrometres(*value);
  }
  for (Opening& opening : storey.openings) {
    opening.a = ToMicrometres(opening.a);
    opening.b = ToMicrometres(opening.b);
  }
}

/// The plan as it was drawn, with its curves.
Floorplan AsDrawn(const Floorplan& plan) {
  Floorplan drawn = plan;
  drawn.dial.reset();
  if (!plan.drawn_storeys.empty()) {
    drawn.storeys = std::exchange(drawn.drawn_storeys, {});
    for (size_t s = 0; s < drawn.storeys.size(); ++s) {
      std::vector<Room>& rooms = drawn.storeys[s].rooms;
      for (size_t r = 0; r < rooms.size(); ++r)
        rooms[r].curve = plan.storeys.at(s).rooms.at(r).curve;
    }
  }
  for (Storey& storey : drawn.storeys) RoundStorey(storey);
  return drawn;
}

bool IsSame(const Polygon2& a, const Polygon2& b) {
  return a.outer == b.outer && a.holes == b.holes;
}

/// A place for an opening on a wall.
struct Place {
  double distance_m = kNone;
  const Wall* wall = nullptr;
  Vector2d a, b;
};

/// The place on `wall` for an opening from a to b, whose wall ran along `along`; without a wall
/// when there is none within reach.
Place PlaceOn(const Wall& wall, const Vector2d& a, const Vector2d& b, const Vector2d& along,
              double reach_m) {
  const double length_m = (wall.b - wall.a).norm();
  const Vector2d direction = (wall.b - wall.a) / length_m;
  const Vector2d normal(-direction.y(), direction.x());
  if (direction.dot(along) < kParallel) return {};
  const double offset_m = std::abs(normal.dot(0.5 * (a + b) - wall.a));
  const double end_a = direction.dot(a - wall.a), end_b = direction.dot(b - wall.a);
  const double begin_m = std::min(end_a, end_b), width_m = std::abs(end_b - end_a);
  if (width_m > length_m + kOnWall_m) return {};
  const double shift_m = std::clamp(begin_m, 0.0, std::max(0.0, length_m - width_m)) - begin_m;
  if (offset_m > reach_m || std::abs(shift_m) > reach_m) return {};
  if (offset_m < kOnWall_m && std::abs(shift_m) < kOnWall_m)
    return {offset_m + std::abs(shift_m), &wall, a, b};
  const auto moved = [&](double end) {
    return ToMicrometres(Vector2d(wall.a + std::clamp(end + shift_m, 0.0, length_m) * direction));
  };
  return {offset_m + std::abs(shift_m), &wall, moved(end_a), moved(end_b)};
}

bool OverlapsOne(const Place& place, const std::vector<Opening>& openings) {
  const Vector2d along = (place.wall->b - place.wall->a).normalized();
  const auto begin = [&](const Vector2d& a, const Vector2d& b) {
    return std::min(along.dot(a), along.dot(b));
  };
  const auto end = [&](const Vector2d& a, const Vector2d& b) {
    return std::max(along.dot(a), along.dot(b));
  };
  return std::any_of(openings.begin(), openings.end(), [&](const Opening& other) {
    return other.wall_id == place.wall->id && begin(other.a, other.b) < end(place.a, place.b) &&
           begin(place.a, place.b) < end(other.a, other.b);
  });
}

/// A storey with other outlines for some of its rooms.
class StoreyTurner {
 public:
  StoreyTurner(const Storey& drawn, double max_wall_m) : drawn_(drawn), max_wall_m_(max_wall_m) {
    storey_ = drawn;
    storey_.walls.clear();
    storey_.openings.clear();
  }

  void Keep(size_t room_idx) {
    for (const Wall& wall : drawn_.walls) {
      if (wall.room_id != storey_.rooms[room_idx].id) continue;
      storey_.walls.push_back(wall);
      storey_.walls.back().id = static_cast<int>(storey_.walls.size()) - 1;
      new_id_[wall.id] = storey_.walls.back().id;
    }
  }

  void Change(size_t room_idx, const OutlineChoice& outline) {
    Room& room = storey_.rooms[room_idx];
    const auto own = std::find_if(drawn_.walls.begin(), drawn_.walls.end(),
                                  [&](const Wall& wall) { return wall.room_id == room.id; });
    ENFILADE_CHECK(own != drawn_.walls.end());
    const size_t first = storey_.walls.size();
    TakeOutline(outline, own->thickness_m, room, storey_);
    for (size_t i = first; i < storey_.walls.size(); ++i) {
      Wall& wall = storey_.walls[i];
      if (const Wall* before = FindWallOfEdge(drawn_, room.id, wall.a, wall.b))
        wall.thickness_m = before->thickness_m;
    }
    changed_.push_back(room_idx);
  }

  /// Returns how many openings were dropped.
  int Finish() {
    if (!changed_.empty()) MeasureAnew();
    std::vector<Opening>& placed = storey_.openings;
    std::vector<Opening> to_move;
    for (const Opening& opening : drawn_.openings) {
      const auto wall = new_id_.find(opening.wall_id);
      (wall != new_id_.end() ? placed : to_move).push_back(opening);
      if (wall != new_id_.end()) placed.back().wall_id = wall->second;
    }
    // What a wall still holds where it was comes before what moves there.
    for (const double reach_m : {kOnWall_m, max_wall_m_})
      std::erase_if(to_move, [&](const Opening& opening) { return Move(opening, reach_m); });
    std::sort(placed.begin(), placed.end(),
              [](const Opening& a, const Opening& b) { return a.id < b.id; });
    for (size_t i = 0; i < placed.size(); ++i) placed[i].id = static_cast<int>(i);
    return static_cast<int>(to_move.size());
  }

  Storey Take() && { return std::move(storey_); }

 private:
  void MeasureAnew() {
    const auto any = [&](const auto& is_told) {
      return std::any_of(drawn_.walls.begin(), drawn_.walls.end(), is_told);
    };
    if (any([](const Wall& wall) { return wall.other_room_id.has_value(); })) {
      for (Wall& wall : storey_.walls) {
        wall.other_room_id.reset();
        wall.is_thickness_measured = false;
      }
      MeasureThickness(max_wall_m_, storey_);
    }
    if (!any([](const Wall& wall) { return wall.length_sigma_m > 0; })) return;
    Storey independent = storey_;
    std::vector<WallSigma> sigmas(storey_.walls.size());  // measured_m 0: nothing is shared
    for (size_t i = 0; i < sigmas.size(); ++i) sigmas[i].sigma_m = storey_.walls[i].sigma_m;
    AssignSumSigmas(sigmas, independent);
    for (const size_t room_idx : changed_) {
      Room& room = storey_.rooms[room_idx];
      room.area_sigma_m2 = independent.rooms[room_idx].area_sigma_m2;
      for (size_t i = 0; i < storey_.walls.size(); ++i) {
        if (storey_.walls[i].room_id == room.id)
          storey_.walls[i].length_sigma_m = independent.walls[i].length_sigma_m;
      }
    }
  }

  /// To the nearest free place on a wall of its room.
  bool Move(Opening opening, double reach_m) {
    const auto before = std::find_if(drawn_.walls.begin(), drawn_.walls.end(),
                                     [&](const Wall& wall) { return wall.id == opening.wall_id; });
    ENFILADE_CHECK(before != drawn_.walls.end());
    const Vector2d along = (before->b - before->a).normalized();
    Place best;
    for (const Wall& wall : storey_.walls) {
      if (wall.room_id != before->room_id) continue;
      const Place place = PlaceOn(wall, opening.a, opening.b, along, reach_m);
      if (place.wall != nullptr && place.distance_m < best.distance_m &&
          !OverlapsOne(place, storey_.openings))
        best = place;
    }
    if (best.wall == nullptr) return false;
    opening.wall_id = best.wall->id;
    opening.a = best.a;
    opening.b = best.b;
    storey_.openings.push_back(opening);
    return true;
  }

  const Storey& drawn_;
  double max_wall_m_;
  Storey storey_;
  std::map<int, int> new_id_;  // of walls that stay
  std::vector<size_t> changed_;
};

}  // namespace

std::vector<int> VertexNumbers(const Floorplan& plan) {
  const std::vector<const Curve*> curves = CurvesOf(plan);
  return Knapsack(curves).Numbers();
}

std::string WhyNoSuchNumber(const Floorplan& plan, int num_vertices) {
  const std::vector<int> numbers = VertexNumbers(plan);
  if (numbers.empty()) return "the plan has no curves of corners";
  const auto above = std::upper_bound(numbers.begin(), numbers.end(), num_vertices);
  std::string nearest;
  if (above == numbers.begin()) {
    nearest = fmt::format("nearest has {}", numbers.front());
  } else if (above == numbers.end()) {
    nearest = fmt::format("nearest has {}", numbers.back());
  } else {
    nearest = fmt::format("nearest have {} and {}", *(above - 1), *above);
  }
  return fmt::format("there is no plan with {} corners; the {} (of {} to {})", num_vertices,
                     nearest, numbers.front(), numbers.back());
}

std::string TellDial(const VertexDial& dial) {
  std::string text = fmt::format(
      "{} corners cost {:.2f} m of unseen wall; no choice of outlines with so many "
      "costs less than {:.2f} m",
      dial.num_vertices, dial.cost_m, dial.bound_m);
  if (dial.num_openings_dropped > 0) {
    text +=
        fmt::format("; openings that find no wall and are dropped: {}", dial.num_openings_dropped);
  }
  return text;
}

void TakeOutline(const OutlineChoice& outline, double wall_thickness_m, Room& room,
                 Storey& storey) {
  room.polygon = outline.polygon;
  double variance = 0;
  const size_t first = AppendWalls(room, wall_thickness_m, storey);
  for (size_t i = first; i < storey.walls.size(); ++i) {
    Wall& wall = storey.walls[i];
    wall.seen = outline.seen.at(i - first);
    wall.sigma_m = outline.sigma_m.at(i - first);
    variance += (wall.b - wall.a).squaredNorm() * wall.sigma_m * wall.sigma_m;
  }
  room.area_sigma_m2 = std::sqrt(variance);
}

std::optional<Floorplan> PlanWithVertices(const Floorplan& plan, int num_vertices,
                                          double max_wall_m) {
  Floorplan dialled = AsDrawn(plan);
  const std::vector<const Curve*> curves = CurvesOf(dialled);
  const Knapsack knapsack(curves);
  if (curves.empty() || knapsack.CostOf(num_vertices) == kNone) return std::nullopt;
  VertexDial dial{num_vertices, ToMicrometres(knapsack.CostOf(num_vertices)),
                  ToMicrometres(LinearBound(curves, num_vertices)), 0};
  const std::vector<size_t> choices = knapsack.ChoicesFor(num_vertices);
  auto choice = choices.begin();
  std::vector<Storey> turned;
  bool is_as_drawn = true;
  for (const Storey& storey : dialled.storeys) {
    StoreyTurner turner(storey, max_wall_m);
    for (size_t r = 0; r < storey.rooms.size(); ++r) {
      const Room& room = storey.rooms[r];
      const OutlineChoice* outline = room.curve.empty() ? nullptr : &room.curve[*choice++];
      if (outline == nullptr || IsSame(outline->polygon, room.polygon)) {
        turner.Keep(r);
      } else {
        turner.Change(r, *outline);
        is_as_drawn = false;
      }
    }
    dial.num_openings_dropped += turner.Finish();
    turned.push_back(std::move(turner).Take());
  }
  if (!is_as_drawn) {
    dialled.drawn_storeys = std::exchange(dialled.storeys, std::move(turned));
    for (Storey& storey : dialled.drawn_storeys) {
      for (Room& room : storey.rooms) room.curve.clear();
    }
  }
  dialled.dial = dial;
  return dialled;
}

}  // namespace enfilade
