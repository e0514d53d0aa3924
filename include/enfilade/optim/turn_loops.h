// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "enfilade/optim/grid_loop.h"

namespace enfilade {

/// A vertex that the loop must pass.
struct GridAnchor {
  int guide_idx = 0;  ///< its place in the guide
  /// The direction in which the loop goes straight on through the anchor; none: the loop may arrive
  /// and leave in any direction, also with a corner at the anchor.
  std::optional<GridHeading> heading;
};

/// What the loops go round, what they pay and where they must pass.
struct TurnLoopProblem {
  GridLoopProblem grid;  ///< its turn_cost is not used: costs are those of the steps alone
  /// A closed walk once round the core, counter-clockwise; consecutive vertices, also the last and
  /// the first, share a row or a column. It may cut through blocked steps: it only says on which
  /// side of the core the loop goes from one anchor to the next. Not needed without anchors.
  std::vector<GridVertex> guide;
  std::vector<GridAnchor>
      anchors;  ///< ascending guide_idx: the order in which the loop passes them
  int max_turns = 64;
  int max_leg_turns = 8;      ///< most turns between adjacent anchors (β of the paper)
  int leg_margin_cells = 40;  ///< a leg stays in the box of its part of the guide, grown by so much
  /// Where the cheapest loop crosses itself, look for the cheapest that does not, with so many
  /// further solves at most for each number of turns. Where they do not suffice the result is the
  /// cheapest found, or the one that crosses itself. Without anchors each costs about as much as
  /// the whole rest.
  int max_untangling_solves = 0;
};

/// The cheapest loop with so many corners.
struct TurnLoop {
  int num_turns = 0;
  int64_t cost = 0;              ///< sum of its steps
  std::vector<GridVertex> ring;  ///< its num_turns corners, counter-clockwise
  /// It visits no vertex twice. Only then is the ring a polygon.
  bool is_simple = false;
};

struct TurnLoopReport {
  GridLoopOutcome outcome = GridLoopOutcome::kNoRoute;
  std::vector<TurnLoop> loops;  ///< ascending num_turns; those numbers for which there is a loop
  int64_t num_relaxed = 0;      ///< states computed, all layers together
};

/// For every number of turns k ≤ max_turns the cheapest closed walk on cell corners that goes round
/// the core once with exactly k corners, and that passes all anchors in their order.
///
/// Requires arrays of the sizes that GridLoopProblem tells, and with anchors a guide that goes once
/// round the core. Legs between adjacent anchors are optimal within their boxes. Anchors that no
/// loop can pass are the outcome kNoRoute. Loops that cost 2²⁹ − 1 or more count as none; with
/// anchors legs that cost 2³⁰ − 1 or more. Closed walks have an even number of turns. With k larger
/// than the costs support the cheapest walk may cross itself, which is_simple tells. Ties are
/// broken the same way on every run.
///
/// Method: docs/algorithms/grid_loop.md. The two-phase dynamic programme of Cabral and Furukawa
/// (CVPR 2014, §5.4) with running minima along rows and columns instead of long edges: O(states)
/// for each number of turns. Memory: one byte for each vertex of the box, level and number of
/// turns.
[[nodiscard]] TurnLoopReport FindLoopsByTurns(const TurnLoopProblem& problem);

}  // namespace enfilade
