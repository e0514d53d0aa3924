// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/pair_graph.h"

#include <queue>

#include "enfilade/base/disjoint_sets.h"
#include "enfilade/sfm/view_graph.h"

namespace enfilade {

std::vector<size_t> SpanningForest(int num_views, std::span<const PanoPair> pairs,
                                   std::span<const double> strengths) {
  std::vector<size_t> order;
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (IsConnecting(pairs[k])) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return strengths[i] > strengths[j]; });
  DisjointSets sets(num_views);
  std::vector<size_t> forest;
  for (const size_t k : order) {
    if (sets.Join(pairs[k].a_idx, pairs[k].b_idx)) forest.push_back(k);
  }
  return forest;
}

void WalkForest(int num_views, std::span<const PanoPair> pairs, std::span<const size_t> forest,
                const std::function<void(int from, int to, const PanoPair& pair)>& visit) {
  std::vector<std::vector<size_t>> at(static_cast<size_t>(num_views));
  for (const size_t k : forest) {
    at[static_cast<size_t>(pairs[k].a_idx)].push_back(k);
    at[static_cast<size_t>(pairs[k].b_idx)].push_back(k);
  }
  std::vector<bool> is_done(static_cast<size_t>(num_views), false);
  for (int root = 0; root < num_views; ++root) {
    if (is_done[static_cast<size_t>(root)]) continue;
    is_done[static_cast<size_t>(root)] = true;
    std::queue<int> queue;
    queue.push(root);
    while (!queue.empty()) {
      const int from = queue.front();
      queue.pop();
      for (const size_t k : at[static_cast<size_t>(from)]) {
        const int to = pairs[k].a_idx == from ? pairs[k].b_idx : pairs[k].a_idx;
        if (is_done[static_cast<size_t>(to)]) continue;
        is_done[static_cast<size_t>(to)] = true;
        visit(from, to, pairs[k]);
        queue.push(to);
      }
    }
  }
}

}  // namespace enfilade
