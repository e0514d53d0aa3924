// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <utility>

#include "enfilade/evaluate/judged_plan.h"

namespace enfilade {

/// Pairs of room indices (smaller first) that a door joins. On either side of a door the first room
/// within half a metre of its centre, square to it, is the one that it leads to; doors that lead
/// out of the rooms join nothing.
[[nodiscard]] std::set<std::pair<int, int>> DoorGraph(const JudgedPlan& plan);

struct DoorFigures {
  std::optional<double> precision, recall;              ///< centres within 0.4 m, one to one
  std::optional<double> graph_precision, graph_recall;  ///< pairs of matched rooms that are joined
};

/// None where a side has no doors, or no pair of rooms that a door joins.
[[nodiscard]] DoorFigures EvaluateDoors(const JudgedPlan& result, const JudgedPlan& truth);

}  // namespace enfilade
