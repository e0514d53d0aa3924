// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/turn_loops.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "enfilade/base/check.h"
#include "src/optim/anchored_loops.h"
#include "src/optim/loop_box.h"
#include "src/optim/seam_loops.h"

namespace enfilade {
namespace {

// The steps of a closed walk with these corners, all of them on one row or column with the next.
std::vector<BoxStep> StepsOf(const LoopBox& box, const std::vector<int>& corners) {
  std::vector<BoxStep> steps;
  for (size_t i = 0; i < corners.size(); ++i) {
    const int from = corners[i], to = corners[(i + 1) % corners.size()];
    const bool is_horizontal = from / box.cols() == to / box.cols();
    const int heading = is_horizontal ? (to > from ? kEast : kWest) : (to > from ? kNorth : kSouth);
    for (int at = from; at != to; at += box.offset(heading)) steps.push_back({at, heading});
  }
  return steps;
}

// Two steps of a closed walk that leave the same vertex in different directions, where it visits a
// vertex twice; none when it does not. A loop that does not cross itself has at most one of them.
std::optional<std::pair<BoxStep, BoxStep>> FindConflict(const LoopBox& box,
                                                        const std::vector<int>& corners) {
  const std::vector<BoxStep> steps = StepsOf(box, corners);
  std::vector<size_t> first_visit(static_cast<size_t>(box.num_vertices()), steps.size());
  for (size_t i = 0; i < steps.size(); ++i) {
    size_t& first = first_visit[static_cast<size_t>(steps[i].vertex)];
    if (first == steps.size()) {
      first = i;
      continue;
    }
    // A walk once round is no repetition of a shorter one: its two visits part somewhere.
    for (size_t a = first, b = i;; a = (a + 1) % steps.size(), b = (b + 1) % steps.size()) {
      if (steps[a].heading != steps[b].heading) return std::pair{steps[a], steps[b]};
    }
  }
  return std::nullopt;
}

class TurnLoopSolver {
 public:
  explicit TurnLoopSolver(const TurnLoopProblem& problem)
      : box_(problem.grid),
        anchored_(problem.anchors.empty() ? nullptr
                                          : std::make_unique<AnchoredLoops>(problem, box_)) {}

  void Find(LoopsByTurns& loops) {
    if (anchored_) {
      anchored_->Find(loops);
    } else {
      FindSeamLoops(box_, loops, num_relaxed_);
    }
  }

  // For a number of turns whose cheapest walk crosses itself: the cheapest loop that does not, or
  // the cheapest found with so many solves; none when none is found. Branches on two steps that
  // leave a vertex which a walk visits twice: one of them is not in the loop.
  std::optional<CornerLoop> Untangle(int num_turns, const CornerLoop& crossing, int max_solves) {
    struct Node {
      CornerLoop loop;
      std::pair<BoxStep, BoxStep> conflict;
      std::vector<BoxStep> blocked;
      int number = 0;
      [[nodiscard]] std::tuple<int64_t, int> Key() const { return {loop.cost, number}; }
      bool operator>(const Node& other) const { return Key() > other.Key(); }
    };
    std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
    open.push({crossing, *FindConflict(box_, crossing.corners), {}, 0});
    CornerLoop best;
    int num_solves = 0;
    while (!open.empty() && open.top().loop.cost < best.cost && num_solves + 2 <= max_solves) {
      const Node node = open.top();
      open.pop();
      for (const BoxStep step : {node.conflict.first, node.conflict.second}) {
        ++num_solves;
        std::vector<BoxStep> blocked = node.blocked;
        blocked.push_back(step);
        CornerLoop loop = FindWithout(blocked, num_turns, best.cost);
        if (loop.corners.empty()) continue;
        if (const auto conflict = FindConflict(box_, loop.corners)) {
          open.push({std::move(loop), *conflict, std::move(blocked), num_solves});
        } else {
          best = std::move(loop);
        }
      }
    }
    return best.corners.empty() ? std::nullopt : std::optional(std::move(best));
  }

  [[nodiscard]] const LoopBox& box() const { return box_; }
  [[nodiscard]] int64_t num_relaxed() const {
    return num_relaxed_ + (anchored_ ? anchored_->num_relaxed() : 0);
  }

 private:
  // The cheapest walk without the blocked steps; it has no corners when it would cost `limit`.
  CornerLoop FindWithout(const std::vector<BoxStep>& blocked, int num_turns, int64_t limit) {
    LoopsByTurns loops(static_cast<size_t>(num_turns) + 1, {0, {}});
    loops.back().cost = limit;
    LoopBox box = box_;
    for (const BoxStep step : blocked) box.Block(step);
    if (anchored_) {
      AnchoredLoops anchored = *anchored_;
      anchored.SolveWithout(blocked, box);
      anchored.Find(loops);
      num_relaxed_ += anchored.num_relaxed() - anchored_->num_relaxed();
    } else {
      FindSeamLoops(box, loops, num_relaxed_);
    }
    return std::move(loops.back());
  }

  LoopBox box_;
  std::unique_ptr<const AnchoredLoops> anchored_;  // none without anchors
  int64_t num_relaxed_ = 0;
};

TurnLoop MakeLoop(const LoopBox& box, int num_turns, const CornerLoop& loop, bool is_simple) {
  TurnLoop result{num_turns, loop.cost, {}, is_simple};
  result.ring.reserve(loop.corners.size());
  for (const int vertex : loop.corners) result.ring.push_back(box.GridVertexOf(vertex));
  return result;
}

}  // namespace

TurnLoopReport FindLoopsByTurns(const TurnLoopProblem& problem) {
  ENFILADE_CHECK(problem.max_turns >= 0 && problem.max_leg_turns >= 0);
  TurnLoopReport report;
  report.outcome = CheckCore(problem.grid);
  if (report.outcome != GridLoopOutcome::kFound) return report;

  TurnLoopSolver solver(problem);
  LoopsByTurns loops(static_cast<size_t>(problem.max_turns) + 1);
  solver.Find(loops);
  for (int k = 0; k <= problem.max_turns; ++k) {
    CornerLoop& loop = loops[static_cast<size_t>(k)];
    if (loop.corners.empty()) continue;
    bool is_simple = !FindConflict(solver.box(), loop.corners);
    if (!is_simple && problem.max_untangling_solves > 0) {
      std::optional<CornerLoop> untangled = solver.Untangle(k, loop, problem.max_untangling_solves);
      is_simple = untangled.has_value();
      if (untangled) loop = std::move(*untangled);
    }
    report.loops.push_back(MakeLoop(solver.box(), k, loop, is_simple));
  }
  report.num_relaxed = solver.num_relaxed();
  if (report.loops.empty()) report.outcome = GridLoopOutcome::kNoRoute;
  return report;
}

}  // namespace enfilade
