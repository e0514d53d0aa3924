// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "enfilade/sfm/types.h"

namespace enfilade {

/// Disjoint sets of 0 … size − 1; the lowest member stands for its set.
class DisjointSets {
 public:
  explicit DisjointSets(int size) : parent_(static_cast<size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  [[nodiscard]] int Find(int i) {
    while (At(i) != i) i = At(i) = At(At(i));
    return i;
  }
  /// False when they were together already.
  bool Join(int i, int j) {
    i = Find(i);
    j = Find(j);
    if (i == j) return false;
    At(std::max(i, j)) = std::min(i, j);
    return true;
  }

 private:
  int& At(int i) { return parent_[static_cast<size_t>(i)]; }
  std::vector<int> parent_;
};

/// Indices of the connecting pairs that form the spanning forest of largest total strength (ties:
/// lowest index), `strengths` one a pair.
[[nodiscard]] std::vector<size_t> SpanningForest(int num_views, std::span<const PanoPair> pairs,
                                                 std::span<const double> strengths);

/// Calls visit(from, to, pair) for the pairs of a forest, breadth first from the lowest view of
/// each tree, so that `from` was reached before `to`.
void WalkForest(int num_views, std::span<const PanoPair> pairs, std::span<const size_t> forest,
                const std::function<void(int from, int to, const PanoPair& pair)>& visit);

}  // namespace enfilade
