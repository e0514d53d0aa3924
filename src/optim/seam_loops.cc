// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/optim/seam_loops.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "src/optim/turn_sweep.h"

namespace enfilade {
namespace {

constexpr int64_t kNoWalk = std::numeric_limits<int64_t>::max() / 2;

// Dearer loops count as none, and no potential is larger: then sums of both stay in range.
constexpr int32_t kMaxCost = TurnSweep::kUnreached / 2;

// Going round once takes a turn for each heading. Going up a level and down again takes eight turns
// more: four to get there, four to return.
constexpr int kTurnsPerRound = 4;
constexpr int kTurnsPerLevel = 8;

// Walks round the core that start and end in an interval of seams.
struct Node {
  SeamInterval seams;
  // Lower bounds of the closed walks, by number of turns and seam of the interval.
  std::vector<int32_t> bound;
  // By seam: what a walk pays to start there and gets back to end there. It changes no closed walk
  // and makes others dearer that would move to cheaper seams.
  std::vector<int32_t> potential;
  int64_t promise = 0;  // least of bound − cost known

  // The most promising first, then from west to east.
  [[nodiscard]] std::tuple<int64_t, int> Key() const { return {promise, seams.first}; }
  friend bool operator>(const Node& a, const Node& b) { return a.Key() > b.Key(); }

  [[nodiscard]] int num_seams() const { return seams.last - seams.first + 1; }
  [[nodiscard]] std::span<int32_t> BoundsOf(int num_turns) {
    const size_t size = static_cast<size_t>(num_seams());
    return std::span(bound).subspan(static_cast<size_t>(num_turns) * size, size);
  }
};

class SeamLoopSearch {
 public:
  SeamLoopSearch(const LoopBox& box, LoopsByTurns& loops)
      : box_(box), loops_(loops), max_turns_(static_cast<int>(loops.size()) - 1) {}

  void Run() {
    std::vector<int> open;
    for (int k = kTurnsPerRound; k <= max_turns_; k += 2) {
      if (Limit(k) > 0) open.push_back(k);
    }
    for (int max_level = 0; !open.empty(); ++max_level) {
      BranchAndBound(max_level, open);
      AddRound();
      std::erase_if(open, [&](int k) { return !NeedsLevel(max_level + 1, k); });
    }
  }

  [[nodiscard]] int64_t num_relaxed() const { return num_relaxed_; }

 private:
  // What a loop must cost less than to be of interest.
  [[nodiscard]] int32_t Limit(int num_turns) const {
    return static_cast<int32_t>(
        std::min<int64_t>(loops_[static_cast<size_t>(num_turns)].cost, kMaxCost));
  }

  // Whether a node may hold a better loop with so many turns.
  [[nodiscard]] bool IsOpen(Node& node, int num_turns) const {
    const std::span<const int32_t> bounds = node.BoundsOf(num_turns);
    return std::any_of(bounds.begin(), bounds.end(),
                       [limit = Limit(num_turns)](int32_t bound) { return bound < limit; });
  }

  void BranchAndBound(int max_level, const std::vector<int>& turns) {
    const SweepWindow window{1, box_.rows() - 2, 1, box_.cols() - 2, 0, max_level};
    TurnSweep sweep(box_, window, turns.back());
    std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
    open.push(MakeRoot(turns));
    for (bool is_root = true; !open.empty(); is_root = false) {
      Node node = open.top();
      open.pop();
      const std::vector<SeamInterval> ends = CloseWalks(sweep, node);
      if (ends.empty()) continue;
      if (is_root) {  // one seam alone gives upper bounds for all numbers of turns
        const int seam = MostFrequentEnd(ends);
        Node single = PartOf(node, {seam, seam});
        if (single.num_seams() > 0) CloseWalks(sweep, single);
      }
      const int split = BestSplit(node.seams, ends);
      for (const SeamInterval seams :
           {SeamInterval{node.seams.first, split}, SeamInterval{split + 1, node.seams.last}}) {
        Node part = PartOf(node, seams);
        if (part.num_seams() > 0) open.push(std::move(part));
      }
    }
    num_relaxed_ += sweep.num_relaxed();
  }

  [[nodiscard]] Node MakeRoot(const std::vector<int>& turns) const {
    const size_t num_seams = static_cast<size_t>(box_.num_seams());
    Node root{{0, box_.num_seams() - 1},
              std::vector(loops_.size() * num_seams, TurnSweep::kUnreached),
              std::vector<int32_t>(num_seams, 0)};
    for (const int k : turns) std::ranges::fill(root.BoundsOf(k), 0);
    return root;
  }

  // The part of a node with the given seams, without those at its ends that need not be looked at.
  [[nodiscard]] Node PartOf(Node& node, SeamInterval seams) const {
    const auto is_open = [&](int seam) {
      for (int k = kTurnsPerRound; k <= max_turns_; k += 2) {
        if (node.BoundsOf(k)[static_cast<size_t>(seam - node.seams.first)] < Limit(k)) return true;
      }
      return false;
    };
    while (seams.first <= seams.last && !is_open(seams.first)) ++seams.first;
    while (seams.first <= seams.last && !is_open(seams.last)) --seams.last;
    Node part{seams, {}, {}, kNoWalk};
    const size_t first = static_cast<size_t>(seams.first - node.seams.first),
                 size = static_cast<size_t>(part.num_seams());
    if (size == 0) return part;
    for (int k = 0; k <= max_turns_; ++k) {
      const std::span<const int32_t> bounds = node.BoundsOf(k).subspan(first, size);
      part.bound.insert(part.bound.end(), bounds.begin(), bounds.end());
      part.promise = std::min<int64_t>(part.promise, std::ranges::min(bounds) - int64_t{Limit(k)});
    }
    const std::span<const int32_t> potential = std::span(node.potential).subspan(first, size);
    const int32_t least = std::ranges::min(potential);
    for (const int32_t value : potential) part.potential.push_back(value - least);
    return part;
  }

  // Finds the cheapest walks through the node's seams, raises its bounds and takes those walks that
  // are closed as loops. Returns the ends of the others; the costs of one of them, by their end,
  // are the potential for the node's parts.
  std::vector<SeamInterval> CloseWalks(TurnSweep& sweep, Node& node) {
    int last = 0;
    for (int k = kTurnsPerRound; k <= max_turns_; k += 2) {
      if (IsOpen(node, k)) last = k;
    }
    std::vector<SeamInterval> ends;
    if (last == 0) return ends;
    const bool is_first_sweep = round_.empty();
    if (is_first_sweep) round_.assign(loops_.size(), kNoWalk);
    std::vector<int32_t> next_potential;
    int32_t widest_gap = 0;
    sweep.StartAtSeams(node.seams.first, node.potential);
    for (int k = 1; k <= last; ++k) {
      sweep.AddTurn();
      if (k % 2 != 0) continue;
      const bool is_open = IsOpen(node, k);
      if (!is_open && !is_first_sweep) continue;
      const std::vector<int32_t> costs = CostsByEnd(sweep, node);
      const int32_t least = RaiseBounds(costs, node.potential, node.BoundsOf(k));
      if (is_first_sweep && least < TurnSweep::kUnreached) round_[static_cast<size_t>(k)] = least;
      if (!is_open || least >= Limit(k)) continue;
      const SeamInterval walk = Close(sweep, node, costs, least);
      if (walk.first == walk.last) continue;
      ends.push_back(walk);
      if (Limit(k) - least <= widest_gap) continue;
      widest_gap = Limit(k) - least;
      next_potential = costs;
    }
    if (!ends.empty()) {
      for (int32_t& value : next_potential) value = std::min(value, kMaxCost);
      node.potential = std::move(next_potential);
    }
    return ends;
  }

  // Costs of the current layer's walks with the potential of their starts, by seam.
  [[nodiscard]] std::vector<int32_t> CostsByEnd(const TurnSweep& sweep, const Node& node) const {
    std::vector<int32_t> costs;
    for (int seam = node.seams.first; seam <= node.seams.last; ++seam) {
      costs.push_back(sweep.CostOf(box_.seam_top() + seam, 1, kNorth));
    }
    return costs;
  }

  // Returns the least cost.
  static int32_t RaiseBounds(std::span<const int32_t> costs, std::span<const int32_t> potential,
                             std::span<int32_t> bounds) {
    int32_t least = TurnSweep::kUnreached;
    for (size_t i = 0; i < costs.size(); ++i) {
      const bool is_reached = costs[i] < TurnSweep::kUnreached;
      const int32_t cost = is_reached ? costs[i] - potential[i] : TurnSweep::kUnreached;
      least = std::min(least, cost);
      bounds[i] = std::max(bounds[i], cost);
    }
    return least;
  }

  // Of the walks that cost `least` takes a closed one as the best loop so far; where there is none,
  // the two ends of one of them differ.
  SeamInterval Close(const TurnSweep& sweep, const Node& node, std::span<const int32_t> costs,
                     int32_t least) {
    SeamInterval ends;
    for (size_t i = costs.size(); i-- > 0;) {
      if (costs[i] == TurnSweep::kUnreached || costs[i] - node.potential[i] != least) continue;
      const int seam = node.seams.first + static_cast<int>(i);
      TurnSweep::Walk walk = sweep.TraceBack(box_.seam_top() + seam, 1, kNorth, sweep.num_turns());
      const int start = walk.start - box_.seam_bottom();
      ends = {std::min(start, seam), std::max(start, seam)};
      if (start != seam) continue;
      loops_[static_cast<size_t>(sweep.num_turns())] = {least, std::move(walk.corners)};
      break;
    }
    return ends;
  }

  // The last seam before the place that separates the ends of most walks; of several such places
  // the one next to the middle.
  static int BestSplit(SeamInterval seams, const std::vector<SeamInterval>& walks) {
    const int middle = (seams.first + seams.last) / 2;
    std::tuple<int64_t, int> best{-1, 0};
    int split = middle;
    for (int place = seams.first; place < seams.last; ++place) {
      const auto num_separated = std::ranges::count_if(
          walks, [&](SeamInterval ends) { return ends.first <= place && place < ends.last; });
      const std::tuple<int64_t, int> score{num_separated, -std::abs(place - middle)};
      if (score <= best) continue;
      best = score;
      split = place;
    }
    return split;
  }

  // Of several the one farthest west.
  static int MostFrequentEnd(const std::vector<SeamInterval>& walks) {
    std::map<int, int> count;
    for (const SeamInterval ends : walks) {
      ++count[ends.first];
      ++count[ends.last];
    }
    return std::ranges::max_element(count, {}, [](const auto& entry) { return entry.second; })
        ->first;
  }

  // Bounds the cost of one round more than so far from below. A walk that reaches a level for the
  // first time went round once on each lower one, after it had come there for the last time.
  void AddRound() {
    if (rounds_.empty()) rounds_.assign(loops_.size(), 0);
    std::vector<int64_t> next(rounds_.size(), kNoWalk);
    for (size_t i = 0; i < next.size(); ++i) {
      if (i > 0) next[i] = next[i - 1];
      for (size_t j = 0; j <= i; ++j) {
        next[i] = std::min(next[i], std::min(kNoWalk, round_[j] + rounds_[i - j]));
      }
    }
    rounds_ = std::move(next);
  }

  // Whether a loop that passes `level`, the highest so far and one more, could be cheaper than the
  // one known. The turns of the way back are not for going up.
  [[nodiscard]] bool NeedsLevel(int level, int num_turns) const {
    if (num_turns < kTurnsPerLevel * level) return false;
    return rounds_[static_cast<size_t>(num_turns - kTurnsPerRound * level)] < Limit(num_turns);
  }

  const LoopBox& box_;
  LoopsByTurns& loops_;
  int max_turns_;
  // By number of turns: the cheapest way from any seam to any other once round, on level 0 alone
  // with exactly so many turns; and as often round as the next level is high, with at most so many.
  std::vector<int64_t> round_, rounds_;
  int64_t num_relaxed_ = 0;
};

}  // namespace

void FindSeamLoops(const LoopBox& box, LoopsByTurns& loops, int64_t& num_relaxed) {
  SeamLoopSearch search(box, loops);
  search.Run();
  num_relaxed += search.num_relaxed();
}

}  // namespace enfilade
