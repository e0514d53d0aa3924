// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

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

}  // namespace enfilade
