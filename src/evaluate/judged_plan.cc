// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/judged_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "enfilade/floorplan/joined_rooms.h"
#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Groups of indices 0 … size − 1 (union-find); the smallest index of a group stands for it.
class Groups {
 public:
  explicit Groups(size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }
  [[nodiscard]] size_t Find(size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void Join(size_t i, size_t j) {
    const size_t a = Find(i), b = Find(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<size_t> parent_;
};

Vector2d ToWorld(const Rigid3& world_from_home, const Vector2d& p) {
  return (world_from_home * Vector3d(p.x(), p.y(), 0)).head<2>();
}

Ring2 ToWorld(const Rigid3& world_from_home, Ring2 ring) {
  for (Vector2d& p : ring) p = ToWorld(world_from_home, p);
  return ring;
}

Polygon2 ToWorld(const Rigid3& world_from_home, const Polygon2& polygon) {
  Polygon2 result{ToWorld(world_from_home, polygon.outer), {}};
  for (const Ring2& hole : polygon.holes) result.holes.push_back(ToWorld(world_from_home, hole));
  return result;
}

double Length(const Segment2& segment) { return (segment[1] - segment[0]).norm(); }
Vector2d Center(const Segment2& segment) { return 0.5 * (segment[0] + segment[1]); }

// Takes rooms that are one together, in the order of their first; the ceiling of the largest stands
// for all.
class RoomJoiner {
 public:
  // `first` is what this room is one with, or the room itself; it has been added before others.
  void Add(size_t first, const MultiPolygon2& region, const MultiPolygon2& passages,
           std::optional<double> ceiling_m) {
    const auto [entry, is_new] = joined_idx_.emplace(first, rooms_.size());
    const size_t j = entry->second;
    if (is_new) {
      rooms_.emplace_back();
      largest_m2_.push_back(-1);
    }
    rooms_[j].region = is_new ? region : Union(rooms_[j].region, region);
    if (!passages.empty()) rooms_[j].region = Union(rooms_[j].region, passages);
    const double area_m2 = Area(region);
    if (area_m2 <= largest_m2_[j]) return;
    largest_m2_[j] = area_m2;
    rooms_[j].ceiling_m = ceiling_m;
  }

  [[nodiscard]] const std::vector<JudgedRoom>& rooms() const { return rooms_; }

 private:
  std::vector<JudgedRoom> rooms_;
  std::map<size_t, size_t> joined_idx_;
  std::vector<double> largest_m2_;  // part of each joined room
};

// The storey's rooms, those that a wide opening joins taken together.
std::vector<JudgedRoom> JoinedRooms(const Storey& storey, const Rigid3& world_from_home) {
  const std::vector<size_t> first = FirstJoinedRooms(storey);
  const std::vector<MultiPolygon2> passages = Passages(storey);
  RoomJoiner joiner;
  for (size_t i = 0; i < storey.rooms.size(); ++i) {
    const Room& room = storey.rooms[i];
    MultiPolygon2 floor;
    for (const Polygon2& passage : passages[i]) floor.push_back(ToWorld(world_from_home, passage));
    joiner.Add(first[i], {ToWorld(world_from_home, room.polygon)}, floor,
               room.ceiling_z - room.floor_z);
  }
  return joiner.rooms();
}

// Interval [first, second] of the segment's length that the opening covers; empty when first ≥
// second.
std::pair<double, double> CoveredInterval(const Segment2& segment, const Segment2& opening) {
  const double length = Length(segment);
  const Vector2d direction = (segment[1] - segment[0]) / length;
  const double a = (opening[0] - segment[0]).dot(direction);
  const double b = (opening[1] - segment[0]).dot(direction);
  return {std::max(0.0, std::min(a, b)), std::min(length, std::max(a, b))};
}

bool IsCutInto(const Segment2& segment, const Segment2& opening) {
  if (!AreParallelWalls(segment, opening)) return false;
  const Vector2d direction = (segment[1] - segment[0]).normalized();
  const Vector2d offset = Center(opening) - segment[0];
  return std::abs(direction.x() * offset.y() - direction.y() * offset.x()) <= kOpeningReach_m;
}

void CutSegment(const Segment2& segment, const std::vector<Segment2>& openings,
                std::vector<Segment2>& parts) {
  std::vector<std::pair<double, double>> cuts;
  for (const Segment2& opening : openings) {
    if (IsCutInto(segment, opening)) cuts.push_back(CoveredInterval(segment, opening));
  }
  std::sort(cuts.begin(), cuts.end());
  const double length = Length(segment);
  const Vector2d direction = (segment[1] - segment[0]) / length;
  const auto keep = [&](double from, double to) {
    if (to > from) parts.push_back({segment[0] + from * direction, segment[0] + to * direction});
  };
  double done = 0;
  for (const auto& [from, to] : cuts) {
    if (from >= to) continue;
    keep(done, from);
    done = std::max(done, to);
  }
  keep(done, length);
}

void AppendEdges(const Ring2& ring, std::vector<Segment2>& edges) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& next = ring[(i + 1) % ring.size()];
    if (ring[i] != next) edges.push_back({ring[i], next});
  }
}

}  // namespace

bool AreParallelWalls(const Segment2& a, const Segment2& b) {
  const double cosine = std::abs((a[1] - a[0]).normalized().dot((b[1] - b[0]).normalized()));
  return cosine >= std::cos(kMaxWallAngle_rad);
}

std::vector<Segment2> OutlineOf(const MultiPolygon2& region) {
  std::vector<Segment2> edges;
  for (const Polygon2& part : region) {
    AppendEdges(part.outer, edges);
    for (const Ring2& hole : part.holes) AppendEdges(hole, edges);
  }
  return edges;
}

std::vector<Segment2> PartsBehind(const Segment2& opening, const std::vector<Segment2>& segments) {
  std::vector<Segment2> parts;
  for (const Segment2& segment : segments) {
    if (!IsCutInto(segment, opening)) continue;
    const auto [from, to] = CoveredInterval(segment, opening);
    const Vector2d direction = (segment[1] - segment[0]).normalized();
    if (from < to) parts.push_back({segment[0] + from * direction, segment[0] + to * direction});
  }
  return parts;
}

std::vector<Segment2> CutOpenings(const std::vector<Segment2>& segments,
                                  const std::vector<Segment2>& openings) {
  std::vector<Segment2> parts;
  for (const Segment2& segment : segments) CutSegment(segment, openings, parts);
  return parts;
}

std::vector<Segment2> MergeDoors(const std::vector<Segment2>& doors) {
  Groups groups(doors.size());
  for (size_t i = 0; i < doors.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if ((Center(doors[i]) - Center(doors[j])).norm() < kDoorDistance_m) groups.Join(i, j);
    }
  }
  std::map<size_t, Segment2> longest;
  for (size_t i = 0; i < doors.size(); ++i) {
    const auto [entry, is_new] = longest.emplace(groups.Find(i), doors[i]);
    if (!is_new && Length(doors[i]) > Length(entry->second)) entry->second = doors[i];
  }
  std::vector<Segment2> merged;
  for (const auto& [group, door] : longest) merged.push_back(door);
  return merged;
}

JudgedPlan JudgedPlanOf(const GroundTruth& truth) {
  JudgedPlan plan;
  RoomJoiner joiner;
  for (size_t i = 0; i < truth.rooms.size(); ++i) {
    const TruthRoom& room = truth.rooms[i];
    std::optional<double> ceiling_m;
    if (room.floor_z && room.ceiling_z) ceiling_m = *room.ceiling_z - *room.floor_z;
    joiner.Add(room.joined_to.value_or(i), room.region, room.passages, ceiling_m);
  }
  plan.rooms = joiner.rooms();
  for (const Segment2& wall : truth.walls) {
    if (Length(wall) > 0) plan.walls.push_back(wall);
  }
  plan.doors = MergeDoors(truth.doors);
  return plan;
}

JudgedPlan JudgedPlanOf(const Floorplan& floorplan) {
  JudgedPlan plan;
  const Rigid3 world_from_home = floorplan.home_from_world.Inverse();
  std::vector<Segment2> doors;
  for (const Storey& storey : floorplan.storeys) {
    std::vector<Segment2> gaps;
    for (const Opening& opening : storey.openings) {
      if (opening.kind == OpeningKind::kWindow || opening.a == opening.b) continue;
      gaps.push_back({ToWorld(world_from_home, opening.a), ToWorld(world_from_home, opening.b)});
      if (opening.kind == OpeningKind::kDoor) doors.push_back(gaps.back());
    }
    for (const Room& room : storey.rooms) {
      const MultiPolygon2 region = {ToWorld(world_from_home, room.polygon)};
      const std::vector<Segment2> walls = CutOpenings(OutlineOf(region), gaps);
      plan.walls.insert(plan.walls.end(), walls.begin(), walls.end());
    }
    std::vector<JudgedRoom> rooms = JoinedRooms(storey, world_from_home);
    std::move(rooms.begin(), rooms.end(), std::back_inserter(plan.rooms));
  }
  plan.doors = MergeDoors(doors);
  return plan;
}

}  // namespace enfilade
