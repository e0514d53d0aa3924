// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/leaks.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "src/floorplan/closet.h"
#include "src/floorplan/edge_cost.h"
#include "src/floorplan/necks.h"
#include "src/floorplan/reflected_walls.h"
#include "src/floorplan/sound_polygon.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kWidestDoor_m = 1.2;  // what is wider makes one room of two
constexpr double kThinnestWall_m = 0.05;
constexpr double kParallel = 0.97;  // cosine
constexpr double kCollinear_m = 1e-6;

// What a neck's removal saves, in metres of wall; negative where the home goes on beyond it.
struct Leak {
  double gain_m = 0;
  bool is_mirror = false;
};

class RoomLeaks {
 public:
  RoomLeaks(const LoopField& field, const FloorplanOptions& options,
            const std::vector<Vector2d>& cameras, const std::vector<Polygon2>& others, size_t index,
            Polygon2& room, LeakReport& report)
      : field_(field),
        options_(options),
        cameras_(cameras),
        others_(others),
        index_(index),
        room_(room),
        report_(report) {}

  void LeaveOut() {
    for (;;) {
      necks_ = FindNecks(room_, cameras_, options_.max_neck_m, options_.min_room_m2);
      const Neck* leakiest = nullptr;
      Leak most;
      for (const Neck& neck : necks_) {
        if (!neck.is_near_straight) continue;
        const Leak leak = Weigh(neck);
        if (leak.gain_m <= most.gain_m || !LeadsOut(neck)) continue;
        leakiest = &neck;
        most = leak;
      }
      if (leakiest == nullptr) return;
      ++report_.num_leaks;
      report_.num_mirrors += most.is_mirror;
      report_.leaks_m2 += Area(leakiest->beyond);
      room_ = leakiest->near;
    }
  }

  // Takes the rooms behind doors off this one.
  [[nodiscard]] std::vector<Polygon2> SetApart() {
    std::vector<Polygon2> rooms;
    while (std::optional<Polygon2> closet = SetOneApart()) {
      rooms.push_back(*std::move(closet));
      ++report_.num_set_apart;
      necks_ = FindNecks(room_, cameras_, options_.max_neck_m, options_.min_room_m2);
    }
    return rooms;
  }

 private:
  [[nodiscard]] Leak Weigh(const Neck& neck) const {
    const ReflectedWalls walls = CompareWithReflection(field_, neck);
    Leak leak{.is_mirror = walls.IsMirror()};
    const double own_seen_m = walls.seen_m - (leak.is_mirror ? walls.repeated_m : 0);
    double with_m = options_.turn_cost_m * NumCornersBeyond(neck);
    for (const auto& [a, b] : WallsBeyond(neck)) with_m += EdgeCost(field_, options_, a, b);
    if (leak.is_mirror) with_m += walls.repeated_m;
    EdgeTerms wall = MeasureEdge(field_, options_, neck.b, neck.a);
    wall.free_outside_m2 = 0;
    leak.gain_m = with_m - own_seen_m - CostOf(wall, options_);
    return leak;
  }

  // How many corners the plan has for what lies beyond. A room behind a door is drawn without it.
  [[nodiscard]] int NumCornersBeyond(const Neck& neck) const {
    const Neck* back = neck.Length() <= kWidestDoor_m ? BackOf(neck) : nullptr;
    if (back != nullptr) return NumVertices(WithoutCollinear(back->beyond, kCollinear_m));
    return NumVertices(room_) - NumVertices(neck.near);
  }

  // Whether most of what lies beyond is out of the home, which closes gaps between its walls.
  [[nodiscard]] bool LeadsOut(const Neck& neck) const {
    MultiPolygon2 home = {neck.near};
    for (size_t i = 0; i < others_.size(); ++i) {
      if (i != index_) home.push_back(others_[i]);
    }
    home =
        OffsetSharp(OffsetSharp(home, 0.5 * options_.unseen_gap_m), -0.5 * options_.unseen_gap_m);
    return Area(Difference({neck.beyond}, home)) > 0.5 * Area(neck.beyond);
  }

  // The room behind the narrowest door that has one.
  [[nodiscard]] std::optional<Polygon2> SetOneApart() {
    std::erase_if(necks_, [](const Neck& neck) { return neck.Length() > kWidestDoor_m; });
    std::stable_sort(necks_.begin(), necks_.end(),
                     [](const Neck& a, const Neck& b) { return a.Length() < b.Length(); });
    for (const Neck& front : necks_) {
      if (!front.is_near_straight) continue;
      const Neck* back = BackOf(front);
      Polygon2 closet = back ? back->beyond : front.beyond;
      if (!back) {
        const MultiPolygon2 walls = OffsetSharp({front.near}, options_.wall_thickness_m);
        closet = LargestPart(Difference({closet}, walls));
      }
      closet = WithoutCollinear(std::move(closet), kCollinear_m);
      if (Area(OpenSharp({closet}, kClosetDepth_m)) < kClosetArea_m2) continue;
      room_ = front.near;
      return closet;
    }
    return std::nullopt;
  }

  // Where the wall ends in which a door is; none where it looks as thin as a line.
  [[nodiscard]] const Neck* BackOf(const Neck& front) const {
    const Vector2d along = (front.b - front.a) / front.Length();
    const Vector2d inwards(-along.y(), along.x());
    for (const Neck& back : necks_) {
      const Vector2d shift = 0.5 * (back.a + back.b - front.a - front.b);
      if (back.is_beyond_straight && along.dot(back.b - back.a) > kParallel * back.Length() &&
          inwards.dot(shift) > kThinnestWall_m && shift.norm() < kThickestWall_m) {
        return &back;
      }
    }
    return nullptr;
  }

  const LoopField& field_;
  const FloorplanOptions& options_;
  const std::vector<Vector2d>& cameras_;
  const std::vector<Polygon2>& others_;  ///< all rooms, as they were
  size_t index_;                         ///< of this one
  Polygon2& room_;
  LeakReport& report_;
  std::vector<Neck> necks_;  ///< of the room as it is
};

}  // namespace

LeakReport LeaveLeaks(const LoopField& field, const FloorplanOptions& options,
                      const std::vector<EvidenceCamera>& cameras, RunContext& context,
                      std::vector<Polygon2>& rooms) {
  const std::vector<Polygon2> others = rooms;
  std::vector<Vector2d> positions;
  for (const EvidenceCamera& camera : cameras) positions.push_back(camera.position);
  std::vector<LeakReport> reports(rooms.size());
  std::vector<std::vector<Polygon2>> closets(rooms.size());
  ParallelFor(context, "leaks", static_cast<int64_t>(rooms.size()), [&](int64_t task) {
    const auto i = static_cast<size_t>(task);
    RoomLeaks leaks(field, options, positions, others, i, rooms[i], reports[i]);
    leaks.LeaveOut();
    closets[i] = leaks.SetApart();
  });
  LeakReport sum;
  for (size_t i = 0; i < reports.size(); ++i) {
    sum.num_leaks += reports[i].num_leaks;
    sum.leaks_m2 += reports[i].leaks_m2;
    sum.num_mirrors += reports[i].num_mirrors;
    sum.num_set_apart += reports[i].num_set_apart;
    rooms.insert(rooms.end(), closets[i].begin(), closets[i].end());
  }
  return sum;
}

}  // namespace enfilade
