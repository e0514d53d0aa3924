// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/optim/loop_box.h"
#include "src/optim/loop_search.h"

namespace enfilade {

/// Part of a LoopBox and of its levels. All bounds are inclusive.
struct SweepWindow {
  int low_row = 0, high_row = 0;  ///< of the box, with its frame
  int low_col = 0, high_col = 0;
  int low_level = 0, high_level = 0;
};

/// Costs of the cheapest walks with exactly k turns from given starts to all states, for
/// k = 0, 1, 2, …; layer by layer, and one step back for each state.
///
/// A state of layer k is (level, vertex, heading of the step that arrived there). With
///
///     G_k(v + step, h) = step(v, h) + min(G_k(v, h), T_{k−1}(v)),
///     T_k(v) = min over the two headings h of layer k of G_k(v, h)
///
/// a layer is one sweep over the rows for each of its two headings: turns are right angles, so
/// layers are vertical and horizontal by turns, and going straight on is the running minimum. No
/// long edge is enumerated.
class TurnSweep {
 public:
  /// Costs from here on mean that there is no walk.
  static constexpr int32_t kUnreached = (int32_t{1} << 30) - 1;

  /// Requires a window within the vertices of the box without its frame. `box` must outlive this.
  TurnSweep(const LoopBox& box, const SweepWindow& window, int max_turns);

  /// Layer 0: walks that have just crossed a seam northwards onto the lowest level, with a cost to
  /// start with for each seam from `first_seam` on.
  void StartAtSeams(int first_seam, std::span<const int32_t> costs);
  /// Layer 0: walks that leave `vertex` (of the box) on `level` with `heading`, without a turn
  /// there.
  void StartAt(int vertex, int level, int heading);
  /// Computes the next layer; at most max_turns times after a start.
  void AddTurn();
  [[nodiscard]] int num_turns() const { return num_turns_; }

  /// Cost of the cheapest walk of the current layer that arrives at the state. Also known on the
  /// level above the window's for states that have just crossed a seam.
  [[nodiscard]] int32_t CostOf(int vertex, int level, int heading) const;

  struct Walk {
    int start = 0;             ///< vertex of the first step; a seam's bottom after StartAtSeams
    std::vector<int> corners;  ///< vertices where the walk turns, in its order
  };
  /// The walk with `num_turns` turns (up to the current layer) that CostOf told of.
  [[nodiscard]] Walk TraceBack(int vertex, int level, int heading, int num_turns) const;

  [[nodiscard]] int64_t num_relaxed() const { return num_relaxed_; }

 private:
  // A byte for each state pair says how it was reached.
  static constexpr uint8_t kFirstIsStraight = 1;   // heading east or north: no turn before the step
  static constexpr uint8_t kSecondIsStraight = 2;  // heading west or south
  static constexpr uint8_t kSecondIsBest = 4;      // T is that of west or south

  [[nodiscard]] bool IsHorizontal(int num_turns) const {
    return ((start_heading_ + num_turns) & 1) == 0;
  }
  [[nodiscard]] size_t Index(int vertex, int level) const;
  [[nodiscard]] uint8_t* Codes(int num_turns) const {
    return codes_.get() + static_cast<size_t>(num_turns) * layer_size_;
  }
  void CopySteps(const LoopBox& box);
  void Start(int heading);
  void SweepLayer();
  void SweepHorizontal();
  void SweepNorth();
  void SweepSouth();
  void KeepOnly(int heading);

  const LoopBox& box_;
  SweepWindow window_;
  int rows_ = 0, cols_ = 0, num_levels_ = 0;
  int top_row_ = 0;   // row at the upper ends of the seams; rows_ when none is in the window
  int seam_col_ = 0;  // first column with a seam
  size_t level_size_ = 0, layer_size_ = 0;
  int start_heading_ = 0;
  int num_turns_ = 0;
  int first_start_seam_ = 0;
  std::span<const int32_t> start_costs_;

  // Steps by heading, one level. Values by level, row and column, and one row more for the walks
  // that leave the highest level northwards.
  std::vector<int32_t> step_[4];
  std::vector<int32_t> first_, second_;  // G of headings east or north, west or south
  std::vector<int32_t> best_;            // T of the last layer, overwritten by the next
  std::vector<int32_t> spare_;           // a row
  std::unique_ptr<uint8_t[]> codes_;     // by number of turns, then as the values
  int64_t num_relaxed_ = 0;
};

}  // namespace enfilade
