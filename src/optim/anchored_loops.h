// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "enfilade/optim/turn_loops.h"
#include "src/optim/loop_box.h"
#include "src/optim/seam_loops.h"
#include "src/optim/turn_sweep.h"

namespace enfilade {

/// The cheapest closed walks through the anchors of a problem, for every number of turns.
///
/// The anchors are lifted along the guide to vertices with levels. Phase 1 sweeps each leg between
/// adjacent anchors and keeps the cheapest way for each number of turns, heading at its start and
/// heading at its end. Phase 2 chains the legs; the first anchor is the seam.
class AnchoredLoops {
 public:
  /// Requires anchors, and a guide that goes round the core of `box` once.
  AnchoredLoops(const TurnLoopProblem& problem, const LoopBox& box);

  /// Replaces each of `loops` by the cheapest one with that many turns, if it costs less.
  void Find(LoopsByTurns& loops) const;

  /// Solves those legs anew that could use one of the steps, which `box` has blocked by now.
  void SolveWithout(const std::vector<BoxStep>& blocked, const LoopBox& box);

  [[nodiscard]] int64_t num_relaxed() const { return num_relaxed_; }

 private:
  /// An anchor on the universal cover.
  struct Stop {
    int vertex = -1;
    int level = 0;
    std::optional<GridHeading> heading;
    int guide_idx = 0;
  };
  struct Way {
    int64_t cost = 0;
    std::vector<int> corners;
  };
  /// Ways by heading at the start, heading at the end and number of turns.
  struct Leg {
    SweepWindow window;
    std::vector<Way> ways;
  };
  struct Chain;

  void LiftAnchors(const TurnLoopProblem& problem, const LoopBox& box);
  [[nodiscard]] SweepWindow WindowOf(size_t leg_idx, const TurnLoopProblem& problem,
                                     const LoopBox& box) const;
  void SolveLeg(size_t leg_idx, const LoopBox& box);
  [[nodiscard]] Stop EndOf(size_t leg_idx) const;
  [[nodiscard]] size_t WayIndex(int start_heading, int end_heading, int num_turns) const;
  [[nodiscard]] Chain ChainLegs(int start_heading, int max_turns) const;
  [[nodiscard]] std::vector<int> TraceChain(const Chain& chain, int num_turns) const;

  int max_leg_turns_ = 0;
  std::vector<int> guide_level_;  ///< by vertex of the guide, and of its first vertex once more
  std::vector<Stop> stops_;       ///< empty when the anchors contradict the box
  std::vector<Leg> legs_;         ///< from each stop to the next
  int64_t num_relaxed_ = 0;
};

}  // namespace enfilade
