// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/rooms.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "enfilade/evaluate/walls.h"
#include "enfilade/geometry/boolean.h"
#include "src/evaluate/point_matching.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
constexpr int kUnmatched = -1;
constexpr double kMinSplitShare = 0.1;
constexpr double kHalf = 0.5;
constexpr double kOutlineShare = 0.95;
constexpr double kNear_m = 0.10;
constexpr double kCornerTolerance_m = 0.01;  // bends flatter than this are no corners

std::vector<double> AreasOf(const std::vector<JudgedRoom>& rooms) {
  std::vector<double> areas;
  for (const JudgedRoom& room : rooms) areas.push_back(Area(room.region));
  return areas;
}

int CountAtLeast(const RoomOverlaps& overlaps, const std::vector<int>& matches, double min_iou) {
  int count = 0;
  for (size_t t = 0; t < matches.size(); ++t) {
    count +=
        matches[t] != kUnmatched && overlaps.iou[t][static_cast<size_t>(matches[t])] >= min_iou;
  }
  return count;
}

int CountSplit(const RoomOverlaps& overlaps) {
  int count = 0;
  for (size_t t = 0; t < overlaps.truth_m2.size(); ++t) {
    int parts = 0;
    for (size_t r = 0; r < overlaps.result_m2.size(); ++r) {
      const double overlap = overlaps.overlap_m2[t][r];
      parts += overlap >= kMinSplitShare * overlaps.truth_m2[t] &&
               overlap >= kHalf * overlaps.result_m2[r];
    }
    count += parts >= 2;
  }
  return count;
}

int CountMerged(const RoomOverlaps& overlaps) {
  int count = 0;
  for (size_t r = 0; r < overlaps.result_m2.size(); ++r) {
    int held = 0;
    for (size_t t = 0; t < overlaps.truth_m2.size(); ++t) {
      held += overlaps.overlap_m2[t][r] > 0 &&
              overlaps.overlap_m2[t][r] >= kHalf * overlaps.truth_m2[t];
    }
    count += held >= 2;
  }
  return count;
}

int CountFalse(const RoomOverlaps& overlaps) {
  int count = 0;
  for (size_t r = 0; r < overlaps.result_m2.size(); ++r) {
    double inside_m2 = 0;
    for (size_t t = 0; t < overlaps.truth_m2.size(); ++t) inside_m2 += overlaps.overlap_m2[t][r];
    count += inside_m2 < kHalf * overlaps.result_m2[r];
  }
  return count;
}

bool IsCovered(const std::vector<Segment2>& outline, const std::vector<Segment2>& by) {
  const std::vector<double> distances = WallDistances(outline, by);
  const auto near =
      std::count_if(distances.begin(), distances.end(), [](double d) { return d <= kNear_m; });
  return static_cast<double>(near) >= kOutlineShare * static_cast<double>(distances.size());
}

int CountSharpRooms(const JudgedPlan& result, const JudgedPlan& truth, const RoomOverlaps& overlaps,
                    const std::vector<int>& matches) {
  int hits = 0;
  for (size_t t = 0; t < matches.size(); ++t) {
    if (matches[t] == kUnmatched) continue;
    const size_t r = static_cast<size_t>(matches[t]);
    if (overlaps.iou[t][r] <= 0.5) continue;
    const std::vector<Segment2> truth_outline = OutlineOf(truth.rooms[t].region);
    const std::vector<Segment2> outline = OutlineOf(result.rooms[r].region);
    hits += IsCovered(truth_outline, outline) && IsCovered(outline, truth_outline);
  }
  return hits;
}

std::vector<Vector2d> CornersOf(const std::vector<JudgedRoom>& rooms) {
  std::vector<Vector2d> corners;
  const auto append = [&](const Ring2& ring) {
    const Ring2 kept = RemoveCollinear(ring, kCornerTolerance_m);
    corners.insert(corners.end(), kept.begin(), kept.end());
  };
  for (const JudgedRoom& room : rooms) {
    for (const Polygon2& part : room.region) {
      append(part.outer);
      for (const Ring2& hole : part.holes) append(hole);
    }
  }
  return corners;
}

std::optional<double> CeilingError(const JudgedPlan& result, const JudgedPlan& truth,
                                   const RoomOverlaps& overlaps) {
  std::vector<double> errors;
  for (size_t t = 0; t < truth.rooms.size(); ++t) {
    const std::vector<double>& overlap = overlaps.overlap_m2[t];
    const auto best = std::max_element(overlap.begin(), overlap.end());
    if (!truth.rooms[t].ceiling_m || best == overlap.end() || *best <= 0) continue;
    const JudgedRoom& room = result.rooms[static_cast<size_t>(best - overlap.begin())];
    if (room.ceiling_m) errors.push_back(std::abs(*room.ceiling_m - *truth.rooms[t].ceiling_m));
  }
  return Median(errors);
}

}  // namespace

RoomOverlaps OverlapRooms(const JudgedPlan& result, const JudgedPlan& truth) {
  RoomOverlaps overlaps{AreasOf(truth.rooms), AreasOf(result.rooms), {}, {}};
  for (size_t t = 0; t < truth.rooms.size(); ++t) {
    std::vector<double> overlap_m2, iou;
    for (size_t r = 0; r < result.rooms.size(); ++r) {
      overlap_m2.push_back(Area(Intersection(truth.rooms[t].region, result.rooms[r].region)));
      const double union_m2 = overlaps.truth_m2[t] + overlaps.result_m2[r] - overlap_m2.back();
      iou.push_back(union_m2 > 0 ? overlap_m2.back() / union_m2 : 0);
    }
    overlaps.overlap_m2.push_back(std::move(overlap_m2));
    overlaps.iou.push_back(std::move(iou));
  }
  return overlaps;
}

std::vector<int> MatchRooms(const RoomOverlaps& overlaps) {
  std::vector<std::tuple<double, size_t, size_t>> pairs;  // (−IoU, truth, result)
  for (size_t t = 0; t < overlaps.truth_m2.size(); ++t) {
    for (size_t r = 0; r < overlaps.result_m2.size(); ++r) {
      if (overlaps.iou[t][r] > 0) pairs.emplace_back(-overlaps.iou[t][r], t, r);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<int> matches(overlaps.truth_m2.size(), kUnmatched);
  std::vector<bool> is_taken(overlaps.result_m2.size(), false);
  for (const auto& [negative_iou, t, r] : pairs) {
    if (matches[t] != kUnmatched || is_taken[r]) continue;
    matches[t] = static_cast<int>(r);
    is_taken[r] = true;
  }
  return matches;
}

RoomFigures EvaluateRooms(const JudgedPlan& result, const JudgedPlan& truth) {
  const RoomOverlaps overlaps = OverlapRooms(result, truth);
  const std::vector<int> matches = MatchRooms(overlaps);
  RoomFigures figures;
  figures.total = static_cast<int>(truth.rooms.size());
  figures.iou50 = CountAtLeast(overlaps, matches, 0.5);
  figures.iou70 = CountAtLeast(overlaps, matches, 0.7);
  figures.iou90 = CountAtLeast(overlaps, matches, 0.9);
  figures.split = CountSplit(overlaps);
  figures.merged = CountMerged(overlaps);
  figures.false_rooms = CountFalse(overlaps);
  figures.f1_10cm = F1(CountSharpRooms(result, truth, overlaps, matches), truth.rooms.size(),
                       result.rooms.size());
  const std::vector<Vector2d> corners = CornersOf(result.rooms),
                              truth_corners = CornersOf(truth.rooms);
  figures.corner_f1_10cm =
      F1(CountPointMatches(truth_corners, corners, kNear_m), truth_corners.size(), corners.size());
  figures.ceiling_median_m = CeilingError(result, truth, overlaps);
  return figures;
}

}  // namespace enfilade
