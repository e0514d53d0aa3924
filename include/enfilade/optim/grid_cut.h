// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace enfilade {

/// The largest capacity of a problem: flow one way makes room for twice as much the other way.
inline constexpr int32_t kMaxGridCapacity = (1 << 30) - 1;

/// A cut between source and sink on a grid of cells in a plane or, with more layers than one, in
/// space, each tied to both and to its four or six neighbours. Capacities are at least 0 and at
/// most kMaxGridCapacity.
struct GridCutProblem {
  int rows = 0;
  int cols = 0;
  int layers = 1;
  std::vector<int32_t> source_capacity;  ///< by Index; paid by cells on the sink's side
  std::vector<int32_t> sink_capacity;    ///< by Index; paid by cells on the source's side
  /// Paid where two neighbours lie on different sides, whichever lies on which.
  std::vector<int32_t> east_capacity;   ///< by Index, between (row, col) and (row, col + 1)
  std::vector<int32_t> north_capacity;  ///< by Index, between (row, col) and (row + 1, col)
  std::vector<int32_t> up_capacity;     ///< by Index, between layers; empty where there is only one

  /// Of a cell in arrays of layers × rows × cols.
  [[nodiscard]] size_t Index(int row, int col, int layer = 0) const {
    return (static_cast<size_t>(layer) * static_cast<size_t>(rows) + static_cast<size_t>(row)) *
               static_cast<size_t>(cols) +
           static_cast<size_t>(col);
  }
};

struct GridCutReport {
  std::vector<uint8_t> is_source;  ///< by Index; 1 for cells on the source's side
  int64_t cost = 0;                ///< of the cut, which equals the largest flow
  int64_t num_augmentations = 0;   ///< paths that flow was sent along
};

/// The cheapest cut, exactly. Of several the one with the smallest source side, which is the common
/// part of all their source sides; so the result does not depend on the order of the search.
///
/// Requires arrays of layers × rows × cols within the bounds above; the last column of
/// east_capacity, the last row of north_capacity and the last layer of up_capacity lead out of the
/// grid and are ignored. Cells and a frame round them are numbered in 32 bits.
///
/// Augmenting paths from two breadth-first trees that are kept and mended: Goldberg, Hed, Kaplan,
/// Tarjan & Werneck, "Maximum Flows by Incremental Breadth-First Search" (ESA 2011), with
/// neighbours found by arithmetic. Memory: 28 bytes a cell, in space 36, and lists. Time O(cells³)
/// at worst; on grids with evidence in most cells about linear, growing with the price of the
/// border.
[[nodiscard]] GridCutReport FindGridCut(const GridCutProblem& problem);

/// What a cut with these sides costs; `is_source` as in GridCutReport.
[[nodiscard]] int64_t CostOfCut(const GridCutProblem& problem,
                                const std::vector<uint8_t>& is_source);

}  // namespace enfilade
