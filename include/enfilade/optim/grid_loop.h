// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace enfilade {

/// Directions of unit steps on a grid: +col, +row, −col, −row, counter-clockwise.
enum class GridHeading : uint8_t { kEast, kNorth, kWest, kSouth };

/// A corner of cells: vertex (row, col) is the low corner of cell (row, col).
struct GridVertex {
  int row = 0;
  int col = 0;
  friend bool operator==(const GridVertex&, const GridVertex&) = default;
};

/// A step that no loop may take.
inline constexpr uint16_t kBlockedStep = 0xFFFF;

/// What the loop goes round and what it pays.
///
/// The loop runs on the corners of the cells, so that it encloses whole cells and its area is
/// theirs. It runs counter-clockwise: the enclosed side is on the left of each step, and since
/// every heading has its own costs, a step can be cheap one way and dear the other way.
struct GridLoopProblem {
  int rows = 0;  ///< of cells
  int cols = 0;
  std::vector<uint8_t> core;        ///< rows × cols; non-zero cells must be enclosed
  std::vector<uint16_t> step_cost;  ///< (rows + 1) × (cols + 1) × 4, see StepIndex
  int turn_cost = 1;                ///< of every right-angle turn, at least 1
  /// The loop stays within the bounding box of the core grown by so many cells.
  int margin_cells = 1 << 20;

  /// Where the cost of the step that leaves vertex (row, col) with `heading` stands. Steps that
  /// would leave the grid are ignored.
  [[nodiscard]] size_t StepIndex(int row, int col, GridHeading heading) const {
    return 4 * (static_cast<size_t>(row) * static_cast<size_t>(cols + 1) +
                static_cast<size_t>(col)) +
           static_cast<size_t>(heading);
  }
};

enum class GridLoopOutcome { kFound, kEmptyCore, kDisconnectedCore, kNoRoute };
[[nodiscard]] std::span<const std::string_view> EnumNames(GridLoopOutcome);

struct GridLoopReport {
  GridLoopOutcome outcome = GridLoopOutcome::kNoRoute;
  std::vector<GridVertex> ring;  ///< corners of the loop, counter-clockwise; empty unless found
  int64_t cost = 0;              ///< sum of its steps and turns
  int64_t num_settled = 0;       ///< states taken from the queues
  int num_searches = 0;          ///< branch-and-bound nodes
  int num_levels = 0;            ///< windings that the proof of optimality needed
};

/// The cheapest closed walk on cell corners that goes round the core once: minimises
/// Σ step_cost + turn_cost · turns over all loops and all seams.
///
/// Requires non-negative costs (given by the type), turn_cost ≥ 1 and arrays of the sizes above.
/// The ring is a simple polygon: cutting a sub-loop out of a walk that visits a vertex twice
/// removes at least three turns and adds at most one. A core that is not connected over cell sides,
/// is empty or cannot be gone round is an outcome, not an error. Ties are broken the same way on
/// every run.
///
/// Method: docs/algorithms/grid_loop.md. The graph of long straight edges of Cabral and Furukawa
/// (CVPR 2014) in its equivalent form with one state a (vertex, heading); states also carry how
/// often they passed a ray from the core, so that walls that fold back over the ray are right; the
/// seam is found by branch and bound. Typical cost: two passes over the states of the box.
[[nodiscard]] GridLoopReport FindShortestLoop(const GridLoopProblem& problem);

}  // namespace enfilade
