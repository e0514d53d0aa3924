// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/doors.h"

#include <algorithm>
#include <vector>

#include "enfilade/evaluate/rooms.h"
#include "src/evaluate/point_matching.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
constexpr int kNoRoom = -1;
constexpr double kDoorStep_m = 0.05;
constexpr int kNumDoorSteps = 10;

std::vector<Vector2d> CentersOf(const std::vector<Segment2>& doors) {
  std::vector<Vector2d> centers;
  for (const Segment2& door : doors) centers.emplace_back(0.5 * (door[0] + door[1]));
  return centers;
}

int RoomAt(const JudgedPlan& plan, const Vector2d& p) {
  for (size_t i = 0; i < plan.rooms.size(); ++i) {
    for (const Polygon2& part : plan.rooms[i].region) {
      if (Contains(part, p)) return static_cast<int>(i);
    }
  }
  return kNoRoom;
}

int FirstRoomAlong(const JudgedPlan& plan, const Vector2d& start, const Vector2d& direction) {
  for (int step = 1; step <= kNumDoorSteps; ++step) {
    const int room = RoomAt(plan, start + step * kDoorStep_m * direction);
    if (room != kNoRoom) return room;
  }
  return kNoRoom;
}

// The result's pairs in the truth's rooms; rooms without a counterpart give indices no true room
// has.
std::set<std::pair<int, int>> ToTruthRooms(const std::set<std::pair<int, int>>& pairs,
                                           const std::vector<int>& result_of_truth) {
  const auto truth_of = [&](int result_room) {
    const auto found = std::find(result_of_truth.begin(), result_of_truth.end(), result_room);
    const auto num_truth = static_cast<int>(result_of_truth.size());
    return found != result_of_truth.end() ? static_cast<int>(found - result_of_truth.begin())
                                          : num_truth + result_room;
  };
  std::set<std::pair<int, int>> mapped;
  for (const auto& [a, b] : pairs) mapped.insert(std::minmax({truth_of(a), truth_of(b)}));
  return mapped;
}

double Share(size_t part, size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::set<std::pair<int, int>> DoorGraph(const JudgedPlan& plan) {
  std::set<std::pair<int, int>> pairs;
  for (const Segment2& door : plan.doors) {
    const Vector2d center = 0.5 * (door[0] + door[1]);
    const Vector2d along = (door[1] - door[0]).normalized();
    const Vector2d across(-along.y(), along.x());
    const int left = FirstRoomAlong(plan, center, across);
    const int right = FirstRoomAlong(plan, center, -across);
    if (left != kNoRoom && right != kNoRoom && left != right) {
      pairs.insert(std::minmax({left, right}));
    }
  }
  return pairs;
}

DoorFigures EvaluateDoors(const JudgedPlan& result, const JudgedPlan& truth) {
  DoorFigures figures;
  if (result.doors.empty() || truth.doors.empty()) return figures;
  const size_t hits = static_cast<size_t>(
      CountPointMatches(CentersOf(truth.doors), CentersOf(result.doors), kDoorDistance_m));
  figures.precision = Share(hits, result.doors.size());
  figures.recall = Share(hits, truth.doors.size());

  const std::set<std::pair<int, int>> truth_pairs = DoorGraph(truth);
  const std::set<std::pair<int, int>> result_pairs =
      ToTruthRooms(DoorGraph(result), MatchRooms(OverlapRooms(result, truth)));
  const auto is_true = [&](const std::pair<int, int>& pair) { return truth_pairs.count(pair) > 0; };
  const auto graph_hits =
      static_cast<size_t>(std::count_if(result_pairs.begin(), result_pairs.end(), is_true));
  if (!result_pairs.empty()) figures.graph_precision = Share(graph_hits, result_pairs.size());
  if (!truth_pairs.empty()) figures.graph_recall = Share(graph_hits, truth_pairs.size());
  return figures;
}

}  // namespace enfilade
