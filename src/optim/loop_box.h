// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "enfilade/optim/grid_loop.h"

namespace enfilade {

inline constexpr int kEast = static_cast<int>(GridHeading::kEast);
inline constexpr int kNorth = static_cast<int>(GridHeading::kNorth);
inline constexpr int kWest = static_cast<int>(GridHeading::kWest);
inline constexpr int kSouth = static_cast<int>(GridHeading::kSouth);

inline int LeftOf(int heading) { return (heading + 1) & 3; }
inline int RightOf(int heading) { return (heading + 3) & 3; }

/// A step that leaves a vertex of a LoopBox.
struct BoxStep {
  int vertex = 0;
  int heading = 0;
};

/// What is found before any search: whether there is one connected core to go round.
[[nodiscard]] GridLoopOutcome CheckCore(const GridLoopProblem& problem);

/// Where a loop may run: the vertices of the core's bounding box grown by the problem's margin, the
/// costs of their steps, and the ray that counts how often a walk goes round.
///
/// Vertices are numbered row by row, with a frame of one vertex all round that no step reaches, so
/// that walking needs no bounds check. The ray runs from the easternmost core cell to the east,
/// where there is no core, through the *seams*: the vertical edges from seam_bottom + s to
/// seam_top + s.
class LoopBox {
 public:
  /// Requires a core that is not empty.
  explicit LoopBox(const GridLoopProblem& problem);

  [[nodiscard]] int rows() const { return rows_; }  ///< of vertices, with the frame
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] int num_vertices() const { return rows_ * cols_; }
  [[nodiscard]] int offset(int heading) const { return offset_[heading]; }
  [[nodiscard]] int num_seams() const { return num_seams_; }
  [[nodiscard]] int seam_bottom() const { return seam_bottom_; }
  [[nodiscard]] int seam_top() const { return seam_top_; }

  /// Cost of the step that leaves `vertex` with `heading`; kBlockedStep out of the box, through the
  /// core, and with the core on the right: a loop round the core has it on its left.
  [[nodiscard]] uint16_t Step(int vertex, int heading) const {
    return step_[static_cast<size_t>(vertex) * 4 + static_cast<size_t>(heading)];
  }
  void Block(BoxStep step) {
    step_[static_cast<size_t>(step.vertex) * 4 + static_cast<size_t>(step.heading)] = kBlockedStep;
  }
  [[nodiscard]] uint16_t max_step() const { return max_step_; }

  /// How the level changes with the step that leaves `vertex` with `heading`: one up with a step
  /// north across the ray, one down with a step south.
  [[nodiscard]] int LevelChange(int vertex, int heading) const {
    if (heading == kNorth) return IsSeamEnd(vertex, seam_bottom_);
    if (heading == kSouth) return -IsSeamEnd(vertex, seam_top_);
    return 0;
  }

  [[nodiscard]] GridVertex GridVertexOf(int vertex) const {
    return {low_row_ + vertex / cols_ - 1, low_col_ + vertex % cols_ - 1};
  }
  /// Number of a vertex of the grid; −1 outside the box.
  [[nodiscard]] int VertexOf(GridVertex at) const;

 private:
  void ChooseBox(const GridLoopProblem& problem);
  void CopySteps(const GridLoopProblem& problem);
  [[nodiscard]] int IsSeamEnd(int vertex, int first) const {
    return static_cast<int>(vertex >= first && vertex < first + num_seams_);
  }

  int low_row_ = 0, low_col_ = 0;  // of the grid, at the box's lowest vertex
  int rows_ = 0, cols_ = 0;
  int offset_[4] = {0, 0, 0, 0};
  int seam_bottom_ = 0, seam_top_ = 0;
  int num_seams_ = 0;
  uint16_t max_step_ = 0;
  std::vector<uint16_t> step_;  // num_vertices × 4
};

}  // namespace enfilade
