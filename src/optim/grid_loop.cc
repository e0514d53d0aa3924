// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/grid_loop.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>

#include "src/optim/loop_box.h"
#include "src/optim/loop_search.h"

namespace enfilade {
namespace {

struct Node {
  int64_t bound;
  SeamInterval seams;
  // Lowest bound first, then from west to east.
  [[nodiscard]] std::tuple<int64_t, int> Key() const { return {bound, seams.first}; }
  friend bool operator>(const Node& a, const Node& b) { return a.Key() > b.Key(); }
};

// Best walk that ends where it starts. The cheapest walk within an interval of seams bounds every
// closed walk through them; when its ends differ, they fall into different halves.
std::optional<SeamPath> CloseByBranchAndBound(LoopSearch& search, int64_t lower_bound,
                                              int& num_searches) {
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  open.push({lower_bound, {0, search.num_seams() - 1}});
  std::optional<SeamPath> best;
  int64_t max_cost = search.upper_bound();
  while (!open.empty() && open.top().bound <= max_cost) {
    const SeamInterval seams = open.top().seams;
    open.pop();
    ++num_searches;
    std::optional<SeamPath> path = search.Find(seams, max_cost);
    if (!path) continue;
    if (path->start_seam == path->end_seam) {
      max_cost = path->cost - 1;
      best = std::move(path);
    } else {
      const int middle = std::midpoint(path->start_seam, path->end_seam);
      const int split = path->start_seam < path->end_seam ? middle : middle - 1;
      open.push({path->cost, {seams.first, split}});
      open.push({path->cost, {split + 1, seams.last}});
    }
  }
  return best;
}

}  // namespace

std::span<const std::string_view> EnumNames(GridLoopOutcome) {
  static constexpr std::array<std::string_view, 4> kNames = {"found", "empty_core",
                                                             "disconnected_core", "no_route"};
  return kNames;
}

GridLoopReport FindShortestLoop(const GridLoopProblem& problem) {
  GridLoopReport report;
  report.outcome = CheckCore(problem);
  if (report.outcome != GridLoopOutcome::kFound) return report;
  report.outcome = GridLoopOutcome::kNoRoute;

  LoopSearch search(problem);
  std::optional<SeamPath> best;
  for (int max_level = 0;; ++max_level) {
    const std::optional<int64_t> lower_bound = search.Prepare(max_level);
    report.num_levels = max_level + 1;
    if (!lower_bound) break;
    best = CloseByBranchAndBound(search, *lower_bound, report.num_searches);
    // A walk through a higher level first goes round max_level + 1 times and then comes back over
    // the ray: at least four turns more.
    const int64_t higher = (max_level + 1) * *lower_bound + 4 * int64_t{problem.turn_cost};
    const int64_t bound = best ? best->cost : search.upper_bound();
    // A simple loop crosses each seam once, so its levels are fewer than the seams.
    if (bound <= higher || max_level + 1 >= search.num_seams()) break;
  }
  report.num_settled = search.num_settled();
  if (!best) return report;
  report.outcome = GridLoopOutcome::kFound;
  report.cost = best->cost;
  report.ring = std::move(best->corners);
  return report;
}

}  // namespace enfilade
