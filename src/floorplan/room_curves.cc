// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/room_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/boolean.h"
#include "enfilade/image/distance_transform.h"
#include "src/floorplan/change_sums.h"
#include "src/floorplan/edge_cost.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/micrometres.h"
#include "src/floorplan/ring_curve.h"
#include "src/floorplan/rooms.h"
#include "src/floorplan/slide.h"
#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kPad_m = 0.5;  // how far round a room other rooms are looked for
constexpr double kForeign_m2 = 1e-3;
constexpr double kOverlap_m2 = 1e-6;
constexpr double kOnLine_m = 0.01;
constexpr double kSameDirection = 1 - 1e-6;  // cosine
constexpr double kLeastCost_m = 1e-6;        // of an outline that is not the plan's

struct Box {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;

  void Add(const Ring2& ring) {
    for (const Vector2d& p : ring) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  [[nodiscard]] bool Meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

Box BoxOf(const Polygon2& polygon) {
  Box box;
  box.Add(polygon.outer);
  return box;
}

/// The cells about a room.
struct Window {
  Window(const GridFrame& frame, const Box& box)
      : first_row(std::max(0, frame.Row(box.low.y() - kPad_m))),
        first_col(std::max(0, frame.Col(box.low.x() - kPad_m))),
        rows(std::min(frame.rows, frame.Row(box.high.y() + kPad_m) + 1) - first_row),
        cols(std::min(frame.cols, frame.Col(box.high.x() + kPad_m) + 1) - first_col) {}
  int first_row, first_col, rows, cols;
};

void AddCells(const GridFrame& frame, const Window& window, const Polygon2& polygon,
              ImageU8& cells) {
  const Box box = BoxOf(polygon);
  const int low_row = std::max(0, frame.Row(box.low.y()) - window.first_row);
  const int low_col = std::max(0, frame.Col(box.low.x()) - window.first_col);
  const int end_row = std::min(window.rows, frame.Row(box.high.y()) - window.first_row + 1);
  const int end_col = std::min(window.cols, frame.Col(box.high.x()) - window.first_col + 1);
  for (int row = low_row; row < end_row; ++row) {
    for (int col = low_col; col < end_col; ++col) {
      if (Contains(polygon, frame.Center(window.first_row + row, window.first_col + col)))
        cells(row, col) = 1;
    }
  }
}

/// Cells outside the room that are not nearer to it than to any other by a wall's thickness.
ImageU8 CellsOfOthers(const GridFrame& frame, const Window& window,
                      const std::vector<Polygon2>& rooms, size_t own_idx, double thickness_m) {
  ImageU8 own(window.rows, window.cols), others(window.rows, window.cols);
  AddCells(frame, window, rooms[own_idx], own);
  for (size_t i = 0; i < rooms.size(); ++i) {
    if (i != own_idx) AddCells(frame, window, rooms[i], others);
  }
  const ImageF to_own = DistanceToMask(own), to_others = DistanceToMask(others);
  const auto thickness = static_cast<float>(thickness_m / frame.cell_m);
  ImageU8 foreign(window.rows, window.cols);
  for (size_t i = 0; i < foreign.data().size(); ++i) {
    foreign.data()[i] =
        own.data()[i] == 0 && to_others.data()[i] < to_own.data()[i] + thickness ? 1 : 0;
  }
  return foreign;
}

/// Length of a → b where no wall is seen and which is no wall of the ring's.
double UnseenBeside(const LoopField& field, const Ring2& ring, const Vector2d& a,
                    const Vector2d& b) {
  const double length = (b - a).norm();
  if (length == 0) return 0;
  const Vector2d along = (b - a) / length, normal(-along.y(), along.x());
  std::vector<std::pair<double, double>> walls;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d from = ring[i] - a, to = ring[(i + 1) % ring.size()] - a;
    if (along.dot((to - from).normalized()) < kSameDirection ||
        std::abs(normal.dot(from)) > kOnLine_m)
      continue;
    const double begin = std::max(0.0, along.dot(from)), end = std::min(length, along.dot(to));
    if (begin < end) walls.emplace_back(begin, end);
  }
  walls.emplace_back(length, length);
  std::sort(walls.begin(), walls.end());
  double unseen_m = 0, at = 0;
  for (const auto& [begin, end] : walls) {
    if (begin > at + kOnLine_m) {
      const Vector2d from = a + at * along, to = a + begin * along;
      unseen_m += (begin - at) * (1 - SeenShare(field, from, to));
    }
    at = std::max(at, end);
  }
  return unseen_m;
}

/// What changes of one room cost.
class RoomPrices {
 public:
  RoomPrices(const LoopField& field, const FloorplanOptions& options,
             const std::vector<Polygon2>& rooms, size_t own_idx,
             const std::vector<Vector2d>& cameras)
      : field_(field), options_(options), sums_(MakeSums(field, options, rooms, own_idx)) {
    for (const Vector2d& camera : cameras) {
      if (Contains(rooms[own_idx], camera)) cameras_.push_back(camera);
    }
  }

  /// Of a corner between walls that did not meet.
  [[nodiscard]] std::optional<double> OfCorner(const Ring2& ring, const RingCorner& corner) const {
    const std::optional<double> area = OfChange(corner.change);
    if (!area) return std::nullopt;
    const Vector2d &from_start = ring[corner.from],
                   &from_end = ring[(corner.from + 1) % ring.size()], &to_start = ring[corner.to],
                   &to_end = ring[(corner.to + 1) % ring.size()];
    double unseen_m = 0;
    if ((from_end - from_start).dot(corner.at - from_end) > 0)
      unseen_m += UnseenBeside(field_, ring, from_end, corner.at);
    if ((to_end - to_start).dot(to_start - corner.at) > 0)
      unseen_m += UnseenBeside(field_, ring, corner.at, to_start);
    return *area + unseen_m;
  }

  /// Of what the closed walk takes away and adds.
  [[nodiscard]] std::optional<double> OfChange(const Ring2& change) const {
    if (!sums_.Covers(change) || TakesAwayCamera(change)) return std::nullopt;
    const ChangeSums sums = sums_.Measure(change);
    if (sums.foreign_gained_m2 > kForeign_m2) return std::nullopt;
    return options_.outside_weight * sums.free_lost_m2 +
           options_.inside_weight * sums.solid_gained_m2;
  }

 private:
  static EvidenceSums MakeSums(const LoopField& field, const FloorplanOptions& options,
                               const std::vector<Polygon2>& rooms, size_t own_idx) {
    const Window window(field.frame, BoxOf(rooms[own_idx]));
    return {field, window.first_row, window.first_col,
            CellsOfOthers(field.frame, window, rooms, own_idx, options.wall_thickness_m)};
  }

  [[nodiscard]] bool TakesAwayCamera(const Ring2& change) const {
    return std::any_of(cameras_.begin(), cameras_.end(),
                       [&](const Vector2d& camera) { return Winding(change, camera) < 0; });
  }

  static int Winding(const Ring2& walk, const Vector2d& p) {
    int winding = 0;
    for (size_t i = 0; i < walk.size(); ++i) {
      const Vector2d a = walk[i] - p, b = walk[(i + 1) % walk.size()] - p;
      if ((a.y() > 0) == (b.y() > 0)) continue;
      const double x = a.x() + a.y() / (a.y() - b.y()) * (b.x() - a.x());
      if (x > 0) winding += b.y() > 0 ? 1 : -1;
    }
    return winding;
  }

  const LoopField& field_;
  const FloorplanOptions& options_;
  EvidenceSums sums_;
  std::vector<Vector2d> cameras_;
};

/// An outline with the wall of the room, in ring order, that each edge comes from.
struct Outline {
  double cost_m = 0;
  Polygon2 polygon;
  std::vector<size_t> wall_idx;
};

/// The outline with one more of the room's holes, simplified.
Outline WithHole(const Outline& outline, const SimplerRing& hole, size_t first_wall) {
  Outline result = outline;
  result.cost_m += hole.cost;
  if (hole.ring.empty()) return result;
  result.polygon.holes.push_back(hole.ring);
  for (const size_t wall : hole.wall_idx) result.wall_idx.push_back(first_wall + wall);
  return result;
}

/// Leaves of outlines with as many corners the cheapest, the first of equals; ascending.
std::vector<Outline> CheapestByCorners(std::vector<Outline> outlines) {
  std::stable_sort(outlines.begin(), outlines.end(), [](const Outline& a, const Outline& b) {
    return std::pair(a.wall_idx.size(), a.cost_m) < std::pair(b.wall_idx.size(), b.cost_m);
  });
  const auto is_as_long = [](const Outline& a, const Outline& b) {
    return a.wall_idx.size() == b.wall_idx.size();
  };
  outlines.erase(std::unique(outlines.begin(), outlines.end(), is_as_long), outlines.end());
  return outlines;
}

/// Of all numbers of corners, the room's own last.
std::vector<Outline> FindOutlines(const RoomPrices& prices, const Polygon2& room) {
  const auto simpler = [&](const Ring2& ring) {
    return FindSimplerRings(
        ring, [&](const RingCorner& corner) { return prices.OfCorner(ring, corner); });
  };
  std::vector<Outline> outlines;
  for (SimplerRing& ring : simpler(room.outer))
    outlines.push_back({ring.cost, {std::move(ring.ring), {}}, std::move(ring.wall_idx)});
  size_t first_wall = room.outer.size();  // that comes next, and so many corners as drawn
  for (const Ring2& hole : room.holes) {
    std::vector<SimplerRing> choices = simpler(hole);
    const Ring2 filled(hole.rbegin(), hole.rend());
    if (const std::optional<double> cost = prices.OfChange(filled))
      choices.push_back({*cost, {}, {}});
    std::vector<Outline> with_hole;
    for (const Outline& outline : outlines) {
      for (const SimplerRing& choice : choices) {
        Outline next = WithHole(outline, choice, first_wall);
        const bool is_drawn = next.wall_idx.size() == first_wall + hole.size();
        if (is_drawn || choice.ring.empty() || IsValidRing(next.polygon, next.polygon.holes.size()))
          with_hole.push_back(std::move(next));
      }
    }
    outlines = CheapestByCorners(std::move(with_hole));
    first_wall += hole.size();
  }
  return outlines;
}

class CurveMaker {
 public:
  CurveMaker(const LoopField& field, const FloorplanOptions& options, const Storey& storey,
             std::vector<Vector2d> cameras)
      : field_(field), options_(options), storey_(storey), cameras_(std::move(cameras)) {
    for (const Room& room : storey.rooms) rooms_.push_back(ToMicrometres(room.polygon));
  }

  [[nodiscard]] std::vector<OutlineChoice> CurveOf(size_t room_idx) const {
    const RoomPrices prices(field_, options_, rooms_, room_idx, cameras_);
    const std::vector<Outline> outlines = FindOutlines(prices, rooms_[room_idx]);
    std::vector<OutlineChoice> curve;
    const std::vector<const Wall*> walls = WallsOf(storey_.rooms[room_idx].id);
    for (const Outline& outline : outlines) {
      const bool is_drawn = &outline == &outlines.back();
      const double cost_m = is_drawn ? 0 : std::max(kLeastCost_m, ToMicrometres(outline.cost_m));
      if (!curve.empty() && cost_m >= curve.back().cost_m) continue;
      OutlineChoice choice{cost_m, ToMicrometres(outline.polygon), {}, {}};
      size_t edge = 0;
      for (const Ring2& ring : RingsOf(choice.polygon)) {
        for (size_t i = 0; i < ring.size(); ++i, ++edge) {
          const Wall& wall = *walls.at(outline.wall_idx[edge]);
          choice.seen.push_back(SeenAs(wall, ring[i], ring[(i + 1) % ring.size()]));
          choice.sigma_m.push_back(ToMicrometres(wall.sigma_m));
        }
      }
      curve.push_back(std::move(choice));
    }
    return curve;
  }

 private:
  [[nodiscard]] std::vector<const Wall*> WallsOf(int room_id) const {
    std::vector<const Wall*> walls;
    for (const Wall& wall : storey_.walls) {
      if (wall.room_id == room_id) walls.push_back(&wall);
    }
    return walls;
  }

  [[nodiscard]] WallSeen SeenAs(const Wall& wall, const Vector2d& a, const Vector2d& b) const {
    if (a == ToMicrometres(wall.a) && b == ToMicrometres(wall.b)) return wall.seen;
    return SeenOf(MeasureWallBand(field_, a, b, options_.slide_m).seen_share);
  }

  const LoopField& field_;
  const FloorplanOptions& options_;
  const Storey& storey_;
  std::vector<Vector2d> cameras_;
  std::vector<Polygon2> rooms_;
};

std::vector<Vector2d> CamerasOf(const Floorplan& plan, size_t storey_idx) {
  std::vector<Vector2d> cameras;
  for (const PlanCamera& camera : plan.cameras) {
    if (static_cast<size_t>(camera.storey_idx) == storey_idx)
      cameras.emplace_back((plan.home_from_world * camera.world_from_cam.translation).head<2>());
  }
  return cameras;
}

/// Drops outlines that overlap one of another room that costs less.
void DropOverlaps(std::vector<Room>& rooms) {
  struct Entry {
    double cost_m;
    size_t room, choice;
    Box box;
  };
  std::vector<Entry> entries;
  for (size_t r = 0; r < rooms.size(); ++r) {
    for (size_t c = 0; c < rooms[r].curve.size(); ++c)
      entries.push_back({rooms[r].curve[c].cost_m, r, c, BoxOf(rooms[r].curve[c].polygon)});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.cost_m < b.cost_m; });
  std::vector<std::vector<const Entry*>> kept(rooms.size());
  std::vector<Box> reach(rooms.size());
  const auto polygon_of = [&](const Entry& entry) -> const Polygon2& {
    return rooms[entry.room].curve[entry.choice].polygon;
  };
  for (const Entry& entry : entries) {
    bool is_apart = true;
    for (size_t r = 0; r < rooms.size() && is_apart && entry.cost_m > 0; ++r) {
      if (r == entry.room || !reach[r].Meets(entry.box)) continue;
      is_apart = std::none_of(kept[r].begin(), kept[r].end(), [&](const Entry* other) {
        return other->box.Meets(entry.box) &&
               Area(Intersection({polygon_of(entry)}, {polygon_of(*other)})) > kOverlap_m2;
      });
    }
    if (!is_apart) continue;
    kept[entry.room].push_back(&entry);
    reach[entry.room].Add({entry.box.low, entry.box.high});
  }
  for (size_t r = 0; r < rooms.size(); ++r) {
    std::vector<OutlineChoice> curve;
    for (auto entry = kept[r].rbegin(); entry != kept[r].rend(); ++entry)
      curve.push_back(std::move(rooms[r].curve[(*entry)->choice]));
    rooms[r].curve = std::move(curve);
  }
}

}  // namespace

void FindRoomCurves(const std::vector<EvidenceGrids>& evidence, const FloorplanOptions& options,
                    RunContext& context, Floorplan& plan) {
  ENFILADE_CHECK(evidence.size() == plan.storeys.size());
  for (size_t s = 0; s < plan.storeys.size(); ++s) {
    Storey& storey = plan.storeys[s];
    if (storey.rooms.empty()) continue;
    const LoopField field = NormaliseEvidence(evidence[s], options);
    const CurveMaker maker(field, options, storey, CamerasOf(plan, s));
    std::vector<std::vector<OutlineChoice>> curves(storey.rooms.size());
    ParallelFor(context, "vertex dial", static_cast<int64_t>(curves.size()), [&](int64_t task) {
      curves[static_cast<size_t>(task)] = maker.CurveOf(static_cast<size_t>(task));
    });
    for (size_t r = 0; r < curves.size(); ++r) storey.rooms[r].curve = std::move(curves[r]);
    DropOverlaps(storey.rooms);
  }
}

}  // namespace enfilade
