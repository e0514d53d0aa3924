// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "src/optim/loop_box.h"

namespace enfilade {

/// A closed walk once round the core, or none yet: then `corners` is empty and `cost` a limit that
/// a loop must stay below to be of interest.
struct CornerLoop {
  int64_t cost = std::numeric_limits<int64_t>::max();
  std::vector<int> corners;  ///< vertices of the LoopBox
};

/// By number of turns, 0 … max_turns.
using LoopsByTurns = std::vector<CornerLoop>;

/// Replaces each of `loops` by the cheapest closed walk round the core with that many turns, if it
/// costs less. Adds the number of computed states to `num_relaxed`.
///
/// One layered sweep from an interval of seams to the same interval bounds all loops through them
/// from below, for all numbers of turns at once; those whose walk ends where it starts are solved,
/// for the others the interval is split. Levels are added until none could help.
void FindSeamLoops(const LoopBox& box, LoopsByTurns& loops, int64_t& num_relaxed);

}  // namespace enfilade
