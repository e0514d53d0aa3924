// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "enfilade/optim/grid_loop.h"
#include "src/optim/loop_box.h"

namespace enfilade {

/// A closed interval of seam positions: the vertical edges where the ray from the core is crossed.
struct SeamInterval {
  int first = 0;
  int last = 0;
};

/// A walk round the core from one seam to another.
struct SeamPath {
  int64_t cost = 0;
  int start_seam = 0;
  int end_seam = 0;
  std::vector<GridVertex> corners;  ///< vertices where the walk turns, in its order
};

/// Shortest walks round the core on the universal cover of the grid without the core.
///
/// A ray runs from the core's easternmost cell to the east. A state is (level, vertex, heading of
/// the step that arrived there); a step north across the ray raises the level, one south lowers it.
/// A walk round the core leads from the north side of a seam at level 0 to the same at level 1.
/// Levels 0 … max_level may be wandered through; lower ones are never needed, because every closed
/// sequence of ups and downs with sum one has a rotation whose partial sums stay positive.
class LoopSearch {
 public:
  /// Requires a core that is not empty.
  explicit LoopSearch(const GridLoopProblem& problem);

  [[nodiscard]] int num_seams() const { return box_.num_seams(); }
  [[nodiscard]] int64_t num_settled() const { return num_settled_; }

  /// Distances from every state to the nearest end of a walk, with levels 0 … max_level. They guide
  /// Find from then on. Stops early where distances exceed any optimum. Returns the cost of the
  /// cheapest walk, whose ends may differ; none when there is no walk.
  [[nodiscard]] std::optional<int64_t> Prepare(int max_level);

  /// The cheapest walk that starts and ends in the interval (A*, guided by Prepare); none when it
  /// would cost more than `max_cost`.
  [[nodiscard]] std::optional<SeamPath> Find(SeamInterval interval, int64_t max_cost);

  /// Upper bound of the cheapest closed walk, known after Prepare.
  [[nodiscard]] int64_t upper_bound() const { return upper_bound_; }

 private:
  using State = uint32_t;
  static constexpr uint32_t kUnreached = std::numeric_limits<uint32_t>::max();

  [[nodiscard]] State MakeState(int level, int vertex, int heading) const {
    return static_cast<State>((level * num_vertices_ + vertex) * 4 + heading);
  }
  [[nodiscard]] State StartOf(int seam) const { return MakeState(0, box_.seam_top() + seam, 1); }
  [[nodiscard]] State EndOf(int seam) const { return MakeState(1, box_.seam_top() + seam, 1); }
  /// Level, vertex and heading of a state.
  struct Parts {
    int level, vertex, heading;
  };
  [[nodiscard]] Parts Split(State state) const;
  /// Seam that `state` has just crossed northwards to reach `level`, or −1.
  [[nodiscard]] int SeamOf(State state, int level) const;

  void RelaxBackward(State state, uint32_t distance);
  void BoundByClosing(int start_seam, uint32_t distance);
  [[nodiscard]] int EndSeamFrom(int start_seam) const;
  [[nodiscard]] int64_t RowCost(int vertex, int num_steps) const;
  void RelaxForward(State state, int64_t max_cost);
  void PushForward(State state, uint32_t cost, int64_t max_cost);
  [[nodiscard]] SeamPath TraceBack(int end_seam) const;
  [[nodiscard]] State Predecessor(State state) const;
  void ResetForward();

  LoopBox box_;
  int num_vertices_ = 0;
  uint32_t turn_cost_ = 0;
  uint32_t max_move_cost_ = 0;

  int max_level_ = 0;
  int64_t upper_bound_ = 0;
  std::vector<uint32_t> to_end_;             // per state, after Prepare
  std::vector<uint32_t> from_start_;         // per state, of the current Find
  std::vector<State> touched_;               // states that Find must reset
  std::vector<std::vector<State>> buckets_;  // Prepare: by distance, modulo their number
  std::vector<uint64_t> heap_;  // Find: least sum of cost so far and to_end_, latest first
  std::vector<State> queued_;   // Find: states in the order in which they were put on the heap
  int64_t num_settled_ = 0;
};

}  // namespace enfilade
