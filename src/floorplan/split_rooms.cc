// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/split_rooms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "enfilade/geometry/boolean.h"
#include "enfilade/image/sampling.h"
#include "src/floorplan/facade_store.h"
#include "src/floorplan/sound_polygon.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinCut_m = 0.7, kMaxCut_m = 8;
constexpr double kMinWallOfCut_m = 0.25;  // of wall evidence along a cut
constexpr float kSeenWall = 0.5F;         // log-odds
constexpr double kClear_m = 0.3;          // between a cut and walls beside it, and between cuts
constexpr double kMinRoomWidth_m = 0.5, kMinRoom_m2 = 0.4;
constexpr double kBesideFrame_m = 0.1;  // casings
constexpr double kMaxOpenShare = 0.35;
// Many lines are asked, few are walls.
constexpr double kMinLogOdds = 1.5;
constexpr double kCollinear_m = 1e-6;

// A straight line through a room from wall to wall along x (axis 0) or y (axis 1).
struct Cut {
  size_t room = 0;
  int axis = 0;
  Vector2d a, b;              // a before b along the axis
  std::vector<bool> is_wall;  // along the cut, a cell each
  double wall_m = 0;          // of them
  double strength = 0;        // sum of the wall's log-odds along and near the cut
  std::vector<std::pair<double, double>> doors;  // from, to along the axis
  double log_odds = -INFINITY;                   // of the surest door

  [[nodiscard]] double Length() const { return (b - a).norm(); }
  [[nodiscard]] double Offset() const { return a[1 - axis]; }
};

// Where the line at `offset` runs inside the polygon: pairs of positions along the axis.
std::vector<std::pair<double, double>> Chords(const Polygon2& polygon, int axis, double offset) {
  std::vector<double> crossings;
  for (const Ring2& ring : RingsOf(polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vector2d& p = ring[i];
      const Vector2d& q = ring[(i + 1) % ring.size()];
      const double u = p[1 - axis] - offset, v = q[1 - axis] - offset;
      if ((u < 0) == (v < 0)) continue;
      crossings.push_back(p[axis] + u / (u - v) * (q[axis] - p[axis]));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  std::vector<std::pair<double, double>> chords;
  for (size_t i = 0; i + 1 < crossings.size(); i += 2)
    chords.emplace_back(crossings[i], crossings[i + 1]);
  return chords;
}

// True when a wall of the polygon runs beside the cut, so that the cut only says what it says.
bool RunsAlongAWall(const Polygon2& polygon, const Cut& cut) {
  for (const Ring2& ring : RingsOf(polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vector2d& p = ring[i];
      const Vector2d& q = ring[(i + 1) % ring.size()];
      const double off = std::max(std::abs(p[1 - cut.axis] - cut.Offset()),
                                  std::abs(q[1 - cut.axis] - cut.Offset()));
      if (off > kClear_m) continue;
      const double common = std::min(std::max(p[cut.axis], q[cut.axis]), cut.b[cut.axis]) -
                            std::max(std::min(p[cut.axis], q[cut.axis]), cut.a[cut.axis]);
      if (common > 0.5 * cut.Length()) return true;
    }
  }
  return false;
}

void MeasureWall(const LoopField& field, Cut& cut) {
  const double cell_m = field.frame.cell_m;
  const int num_cells = std::max(1, static_cast<int>(cut.Length() / cell_m));
  Vector2d across(0, 0);
  across[1 - cut.axis] = cell_m;
  for (int k = 0; k < num_cells; ++k) {
    const Vector2d p = cut.a + (k + 0.5) / num_cells * (cut.b - cut.a);
    float wall = 0;
    for (int side = -2; side <= 2; ++side) {
      const Vector2d pixel = (p + side * across - field.frame.origin) / cell_m;
      const float at = SampleBilinear(field.wall, pixel.x(), pixel.y());
      wall = std::max(wall, at);
      cut.strength += (3 - std::abs(side)) * std::max(at, 0.0F);
    }
    cut.is_wall.push_back(wall > kSeenWall);
    cut.wall_m += cut.is_wall.back() ? cell_m : 0;
  }
}

// The lines through a room with most wall evidence, none beside another.
std::vector<Cut> CutsOf(const LoopField& field, const Polygon2& polygon, size_t room) {
  std::vector<Cut> cuts;
  Vector2d low = polygon.outer.front(), high = low;
  for (const Vector2d& p : polygon.outer) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double cell_m = field.frame.cell_m, origin = field.frame.origin[1 - axis];
    const int first = static_cast<int>(std::ceil((low[1 - axis] - origin) / cell_m));
    const int last = static_cast<int>(std::floor((high[1 - axis] - origin) / cell_m));
    for (int line = first; line < last; ++line) {
      const double offset = origin + (line + 0.5) * cell_m;
      for (const auto& [from, to] : Chords(polygon, axis, offset)) {
        Cut cut;
        cut.room = room;
        cut.axis = axis;
        cut.a[axis] = from;
        cut.b[axis] = to;
        cut.a[1 - axis] = cut.b[1 - axis] = offset;
        if (cut.Length() < kMinCut_m || cut.Length() > kMaxCut_m) continue;
        if (RunsAlongAWall(polygon, cut)) continue;
        MeasureWall(field, cut);
        if (cut.wall_m >= kMinWallOfCut_m) cuts.push_back(std::move(cut));
      }
    }
  }
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const Cut& x, const Cut& y) { return x.strength > y.strength; });
  std::vector<Cut> kept;
  for (Cut& cut : cuts) {
    const bool is_beside = std::any_of(kept.begin(), kept.end(), [&](const Cut& other) {
      return other.axis == cut.axis && std::abs(other.Offset() - cut.Offset()) < kClear_m &&
             other.a[cut.axis] < cut.b[cut.axis] && cut.a[cut.axis] < other.b[cut.axis];
    });
    if (!is_beside) kept.push_back(std::move(cut));
  }
  return kept;
}

// What of a cut is neither wall nor door, 0–1.
double OpenShare(const Cut& cut) {
  size_t num_open = 0;
  const auto count = static_cast<double>(cut.is_wall.size());
  for (size_t k = 0; k < cut.is_wall.size(); ++k) {
    const double at = cut.a[cut.axis] + (static_cast<double>(k) + 0.5) / count * cut.Length();
    const bool is_door = std::any_of(cut.doors.begin(), cut.doors.end(), [&](const auto& door) {
      return at > door.first - kBesideFrame_m && at < door.second + kBesideFrame_m;
    });
    num_open += !cut.is_wall[k] && !is_door;
  }
  return static_cast<double>(num_open) / count;
}

// The wall along a cut: its face is where the evidence peaks, its body on the side where the space
// is less free. Returns where it begins and ends across the cut.
std::pair<double, double> BodyAcross(const LoopField& field, const Cut& cut, double thickness_m) {
  constexpr int kReach = 4;  // cells
  const double cell_m = field.frame.cell_m;
  double sum = 0, moment = 0, free_below = 0, free_above = 0;
  const auto count = static_cast<double>(cut.is_wall.size());
  for (int k = -kReach; k <= kReach; ++k) {
    double wall = 0, free = 0;
    for (size_t i = 0; i < cut.is_wall.size(); ++i) {
      if (!cut.is_wall[i]) continue;
      Vector2d p = cut.a + (static_cast<double>(i) + 0.5) / count * (cut.b - cut.a);
      p[1 - cut.axis] += k * cell_m;
      const Vector2d pixel = (p - field.frame.origin) / cell_m;
      wall += std::max(SampleBilinear(field.wall, pixel.x(), pixel.y()), 0.0F);
      free += SampleBilinear(field.freeness, pixel.x(), pixel.y());
    }
    if (std::abs(k) <= 2) {
      sum += wall;
      moment += k * cell_m * wall;
    }
    (k < 0 ? free_below : free_above) += k == 0 ? 0 : free;
  }
  const double face = cut.Offset() + (sum > 0 ? moment / sum : 0);
  return free_below < free_above ? std::pair(face - thickness_m, face)
                                 : std::pair(face, face + thickness_m);
}

// The parts of a polygon beside the wall along the cut; empty unless each is a room's size.
MultiPolygon2 PartsBeside(const Polygon2& room, const LoopField& field, const Cut& cut,
                          double thickness_m) {
  constexpr double kBeyond_m = 0.05;
  const auto [low, high] = BodyAcross(field, cut, thickness_m);
  Ring2 strip(4);
  for (size_t i = 0; i < 4; ++i) {
    const bool is_end = i == 1 || i == 2, is_high = i >= 2;
    strip[i][cut.axis] = is_end ? cut.b[cut.axis] + kBeyond_m : cut.a[cut.axis] - kBeyond_m;
    strip[i][1 - cut.axis] = is_high ? high : low;
  }
  if (SignedArea(strip) < 0) std::reverse(strip.begin(), strip.end());
  MultiPolygon2 parts = Difference({room}, {{strip, {}}});
  if (parts.size() < 2) return {};
  for (Polygon2& part : parts) {
    part = WithRingsApart(std::move(part), kCollinear_m);
    const Polygon2 inner = LargestPart(OffsetSharp({part}, -0.5 * kMinRoomWidth_m));
    if (inner.outer.empty() || Area(part) < kMinRoom_m2) return {};
  }
  return parts;
}

// A room, or a part of one that was cut.
struct RoomPart {
  Polygon2 polygon;
  double floor_z = 0, ceiling_z = 0;
  bool is_new = true;  ///< not looked at yet
};

class RoomSplitter {
 public:
  RoomSplitter(const Scene& scene, const Rigid3& home_from_world, const LoopField& field,
               int storey_idx, double wall_thickness_m, const OpeningOptions& options,
               FacadeStore& facades, RunContext& context)
      : scene_(scene),
        home_from_world_(home_from_world),
        field_(field),
        storey_idx_(storey_idx),
        wall_thickness_m_(wall_thickness_m),
        options_(options),
        facades_(facades),
        context_(context),
        cameras_(CamerasInPlan(scene, home_from_world, storey_idx)) {}

  // Cuts every new part along its surest cut. Returns whether there was any.
  [[nodiscard]] bool SplitOnce(std::vector<RoomPart>& parts) const {
    std::vector<Cut> cuts;
    for (size_t i = 0; i < parts.size(); ++i) {
      if (!parts[i].is_new) continue;
      for (Cut& cut : CutsOf(field_, parts[i].polygon, i)) cuts.push_back(std::move(cut));
    }
    if (cuts.empty()) return false;
    FindDoorsIn(parts, cuts);
    std::stable_sort(cuts.begin(), cuts.end(),
                     [](const Cut& x, const Cut& y) { return x.log_odds > y.log_odds; });
    std::vector<RoomPart> next;
    bool is_cut = false;
    for (size_t i = 0; i < parts.size(); ++i) {
      const std::vector<RoomPart> halves = SplitAtSurest(parts[i], i, cuts);
      is_cut = is_cut || halves.size() > 1;
      next.insert(next.end(), halves.begin(), halves.end());
    }
    parts = std::move(next);
    return is_cut;
  }

 private:
  // Shows every cut to the pictures from both sides, and the walls for the height of their heads.
  void FindDoorsIn(const std::vector<RoomPart>& parts, std::vector<Cut>& cuts) const {
    std::vector<PicturedWall> walls;
    const auto add = [&](const Vector2d& a, const Vector2d& b, const RoomPart& part) {
      walls.emplace_back(a, b, storey_idx_, part.polygon, part.floor_z, part.ceiling_z,
                         options_.step_m);
    };
    for (const Cut& cut : cuts) {
      add(cut.a, cut.b, parts[cut.room]);
      add(cut.b, cut.a, parts[cut.room]);
    }
    for (const RoomPart& part : parts) {
      const Ring2& ring = part.polygon.outer;
      for (size_t i = 0; i < ring.size(); ++i) {
        const Vector2d& next = ring[(i + 1) % ring.size()];
        if ((next - ring[i]).norm() >= kMinPicturedWall_m) add(ring[i], next, part);
      }
    }
    LookAtWalls(scene_, home_from_world_, facades_, context_, walls);
    if (const std::optional<double> head_m = FindFrames(context_, walls))
      RateCuts(walls, *head_m, cuts);
    for (size_t i = 2 * cuts.size(); i < walls.size(); ++i) facades_.Keep(std::move(walls[i]));
  }

  void RateCuts(const std::vector<PicturedWall>& walls, double head_m,
                std::vector<Cut>& cuts) const {
    for (const DoorCandidate& door :
         FindDoors(walls, storey_idx_, cameras_, head_m, wall_thickness_m_)) {
      if (door.wall / 2 >= cuts.size()) continue;
      Cut& cut = cuts[door.wall / 2];
      // Cameras stand everywhere in a room: that one is near says nothing of a wall.
      cut.log_odds = std::max(cut.log_odds, DoorLogOdds(door.frame, head_m, std::nullopt));
      if (door.log_odds >= options_.min_door_log_odds)
        cut.doors.push_back(std::minmax(door.a[cut.axis], door.b[cut.axis]));
    }
  }

  [[nodiscard]] std::vector<RoomPart> SplitAtSurest(const RoomPart& part, size_t room,
                                                    const std::vector<Cut>& cuts) const {
    for (const Cut& cut : cuts) {
      if (cut.log_odds < kMinLogOdds) break;
      if (cut.room != room || OpenShare(cut) > kMaxOpenShare) continue;
      std::vector<RoomPart> halves;
      for (Polygon2& polygon : PartsBeside(part.polygon, field_, cut, wall_thickness_m_))
        halves.push_back({std::move(polygon), part.floor_z, part.ceiling_z, true});
      if (!halves.empty()) return halves;
    }
    RoomPart whole = part;
    whole.is_new = false;
    return {whole};
  }

  const Scene& scene_;
  const Rigid3& home_from_world_;
  const LoopField& field_;
  int storey_idx_;
  double wall_thickness_m_;
  const OpeningOptions& options_;
  FacadeStore& facades_;
  RunContext& context_;
  std::vector<Vector2d> cameras_;
};

}  // namespace

std::vector<Polygon2> SplitRoomsAtDoors(const Scene& scene, const Rigid3& home_from_world,
                                        const LoopField& field, const Storey& storey,
                                        int storey_idx, double wall_thickness_m,
                                        const OpeningOptions& options, FacadeStore& facades,
                                        RunContext& context) {
  std::vector<RoomPart> parts;
  for (const Room& room : storey.rooms)
    parts.push_back({room.polygon, room.floor_z, room.ceiling_z, true});
  const RoomSplitter splitter(scene, home_from_world, field, storey_idx, wall_thickness_m, options,
                              facades, context);
  const bool has_pictures = std::any_of(scene.views.begin(), scene.views.end(),
                                        [&](const View& view) { return !view.path.empty(); });
  while (has_pictures && splitter.SplitOnce(parts)) {
  }
  std::vector<Polygon2> polygons;
  for (const RoomPart& part : parts) polygons.push_back(part.polygon);
  return polygons;
}

}  // namespace enfilade
