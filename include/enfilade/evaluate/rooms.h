// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "enfilade/evaluate/judged_plan.h"

namespace enfilade {

/// Which rooms of truth and result share ground: overlap_m2[truth][result] and IoU.
struct RoomOverlaps {
  std::vector<double> truth_m2, result_m2;           ///< areas
  std::vector<std::vector<double>> overlap_m2, iou;  ///< [truth][result]
};

[[nodiscard]] RoomOverlaps OverlapRooms(const JudgedPlan& result, const JudgedPlan& truth);

/// For each true room its result room, −1 for none: pairs are taken in the order of falling IoU
/// (ties: lower indices first) while both rooms are free, down to IoU > 0.
[[nodiscard]] std::vector<int> MatchRooms(const RoomOverlaps& overlaps);

struct RoomFigures {
  int total = 0;                        ///< true rooms
  int iou50 = 0, iou70 = 0, iou90 = 0;  ///< matched pairs with at least that IoU
  /// True rooms of which two or more result rooms each cover at least a tenth while lying at least
  /// half inside it.
  int split = 0;
  /// Result rooms that hold at least half of two or more true rooms.
  int merged = 0;
  /// Result rooms that lie less than half in true rooms.
  int false_rooms = 0;
  /// F1 of hits: matched, IoU > 0.5, and 95 % of either outline within 10 cm of the other. None
  /// when neither side has a room.
  std::optional<double> f1_10cm;
  /// F1 of the rooms' corners, one to one within 10 cm.
  std::optional<double> corner_f1_10cm;
  /// Median over true rooms with a level ceiling of the error of the height of the result room that
  /// shares most ground with them.
  std::optional<double> ceiling_median_m;
};

[[nodiscard]] RoomFigures EvaluateRooms(const JudgedPlan& result, const JudgedPlan& truth);

}  // namespace enfilade
