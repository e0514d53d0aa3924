// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/optim/anchored_loops.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

constexpr int64_t kNoWalk = std::numeric_limits<int64_t>::max() / 2;

bool Allows(const std::optional<GridHeading>& heading, int other) {
  return !heading || static_cast<int>(*heading) == other;
}

// Whether a loop may arrive with one heading and leave with another: straight on or with a right
// angle, and only straight on where the heading is given.
bool MayPass(const std::optional<GridHeading>& heading, int arriving, int leaving) {
  return Allows(heading, arriving) && Allows(heading, leaving) &&
         leaving != LeftOf(LeftOf(arriving));
}

}  // namespace

// Phase 2 for loops that leave the first stop with one heading: costs from there on, by leg,
// heading and number of turns, each with the choice that led to it.
struct AnchoredLoops::Chain {
  struct Link {
    int64_t cost = kNoWalk;
    int heading = 0;    // at the link before
    int leg_turns = 0;  // of an arrival: turns on its leg
  };

  Chain(int heading, size_t num_legs, int most_turns)
      : start_heading(heading),
        max_turns(most_turns),
        leaving((num_legs + 1) * 4 * static_cast<size_t>(most_turns + 1)),
        arriving(leaving.size()) {}

  [[nodiscard]] size_t Index(size_t stop, int heading, int num_turns) const {
    return (stop * 4 + static_cast<size_t>(heading)) * static_cast<size_t>(max_turns + 1) +
           static_cast<size_t>(num_turns);
  }

  int start_heading;
  int max_turns;
  // By stop; the last is the first once more. Arriving counts the turns before the stop, leaving
  // those at it, too.
  std::vector<Link> leaving, arriving;
};

AnchoredLoops::AnchoredLoops(const TurnLoopProblem& problem, const LoopBox& box)
    : max_leg_turns_(std::min(problem.max_leg_turns, problem.max_turns)) {
  LiftAnchors(problem, box);
  if (std::ranges::any_of(stops_, [](const Stop& stop) { return stop.vertex < 0; })) {
    stops_.clear();  // one lies out of the box
  }
  legs_.resize(stops_.size());
  for (size_t i = 0; i < legs_.size(); ++i) {
    legs_[i].window = WindowOf(i, problem, box);
    SolveLeg(i, box);
  }
}

// Counts the crossings of the ray along the guide. Anchors that follow each other at the same place
// and ask for the same are one.
void AnchoredLoops::LiftAnchors(const TurnLoopProblem& problem, const LoopBox& box) {
  const std::vector<GridVertex>& guide = problem.guide;
  ENFILADE_CHECK(!guide.empty());
  const GridVertex seam = box.GridVertexOf(box.seam_bottom());
  guide_level_.push_back(0);
  for (size_t i = 0; i < guide.size(); ++i) {
    const GridVertex a = guide[i], b = guide[(i + 1) % guide.size()];
    ENFILADE_CHECK(a.row == b.row || a.col == b.col);
    const bool is_beyond_core = a.col >= seam.col;
    const int change = static_cast<int>(b.row > seam.row) - static_cast<int>(a.row > seam.row);
    guide_level_.push_back(guide_level_.back() + (is_beyond_core ? change : 0));
  }
  ENFILADE_CHECK(guide_level_.back() == 1);

  const auto merge = [](Stop& stop, const Stop& next, int level_change) {
    if (next.vertex != stop.vertex || next.level != stop.level + level_change) return false;
    if (stop.heading && next.heading && stop.heading != next.heading) return false;
    if (!stop.heading) stop.heading = next.heading;
    return true;
  };
  for (const GridAnchor& anchor : problem.anchors) {
    const size_t idx = static_cast<size_t>(anchor.guide_idx);
    ENFILADE_CHECK(anchor.guide_idx >= 0 && idx < guide.size());
    ENFILADE_CHECK(stops_.empty() || anchor.guide_idx >= stops_.back().guide_idx);
    const Stop stop{box.VertexOf(guide[idx]), guide_level_[idx], anchor.heading, anchor.guide_idx};
    if (stops_.empty() || !merge(stops_.back(), stop, 0)) stops_.push_back(stop);
  }
  if (stops_.size() > 1 && merge(stops_.front(), stops_.back(), 1)) stops_.pop_back();
}

AnchoredLoops::Stop AnchoredLoops::EndOf(size_t leg_idx) const {
  if (leg_idx + 1 < stops_.size()) return stops_[leg_idx + 1];
  Stop end = stops_.front();
  end.level += 1;
  end.guide_idx += static_cast<int>(guide_level_.size()) - 1;
  return end;
}

// The box and the levels of the leg's part of the guide, grown.
SweepWindow AnchoredLoops::WindowOf(size_t leg_idx, const TurnLoopProblem& problem,
                                    const LoopBox& box) const {
  const GridVertex frame = box.GridVertexOf(0);
  const size_t num_guide = problem.guide.size();
  const Stop start = stops_[leg_idx];
  const auto clamped_row = [&](int row) { return std::clamp(row - frame.row, 1, box.rows() - 2); };
  const auto clamped_col = [&](int col) { return std::clamp(col - frame.col, 1, box.cols() - 2); };
  SweepWindow window{box.rows(), 0, box.cols(), 0, start.level, start.level};
  for (int i = start.guide_idx; i <= EndOf(leg_idx).guide_idx; ++i) {
    const size_t idx = static_cast<size_t>(i) % num_guide;
    const int level = guide_level_[idx] + (idx < static_cast<size_t>(i) ? 1 : 0);
    const int margin = std::max(problem.leg_margin_cells, 0);
    const GridVertex at = problem.guide[idx];
    window.low_row = std::min(window.low_row, clamped_row(at.row - margin));
    window.high_row = std::max(window.high_row, clamped_row(at.row + margin));
    window.low_col = std::min(window.low_col, clamped_col(at.col - margin));
    window.high_col = std::max(window.high_col, clamped_col(at.col + margin));
    window.low_level = std::min(window.low_level, level);
    window.high_level = std::max(window.high_level, level);
  }
  const int top_row = box.seam_top() / box.cols(), seam_col = box.seam_top() % box.cols();
  const bool has_seam =
      window.low_row < top_row && window.high_row >= top_row && window.high_col >= seam_col;
  if (has_seam) {
    --window.low_level;
    ++window.high_level;
  }
  return window;
}

size_t AnchoredLoops::WayIndex(int start_heading, int end_heading, int num_turns) const {
  return static_cast<size_t>(start_heading * 4 + end_heading) *
             static_cast<size_t>(max_leg_turns_ + 1) +
         static_cast<size_t>(num_turns);
}

void AnchoredLoops::SolveLeg(size_t leg_idx, const LoopBox& box) {
  const Stop start = stops_[leg_idx], end = EndOf(leg_idx);
  Leg& leg = legs_[leg_idx];
  leg.ways.assign(WayIndex(4, 0, 0), {kNoWalk, {}});
  TurnSweep sweep(box, leg.window, max_leg_turns_);
  for (int start_heading = 0; start_heading < 4; ++start_heading) {
    if (!Allows(start.heading, start_heading)) continue;
    sweep.StartAt(start.vertex, start.level, start_heading);
    while (true) {
      for (int end_heading = 0; end_heading < 4; ++end_heading) {
        const int32_t cost = sweep.CostOf(end.vertex, end.level, end_heading);
        if (!Allows(end.heading, end_heading) || cost == TurnSweep::kUnreached) continue;
        leg.ways[WayIndex(start_heading, end_heading, sweep.num_turns())] = {
            cost, sweep.TraceBack(end.vertex, end.level, end_heading, sweep.num_turns()).corners};
      }
      if (sweep.num_turns() == max_leg_turns_) break;
      sweep.AddTurn();
    }
  }
  num_relaxed_ += sweep.num_relaxed();
}

void AnchoredLoops::SolveWithout(const std::vector<BoxStep>& blocked, const LoopBox& box) {
  for (size_t i = 0; i < legs_.size(); ++i) {
    const SweepWindow& window = legs_[i].window;
    const auto contains = [&](int vertex) {
      const int row = vertex / box.cols(), col = vertex % box.cols();
      return row >= window.low_row && row <= window.high_row && col >= window.low_col &&
             col <= window.high_col;
    };
    const bool could_use = std::ranges::any_of(blocked, [&](BoxStep step) {
      return contains(step.vertex) && contains(step.vertex + box.offset(step.heading));
    });
    if (could_use) SolveLeg(i, box);
  }
}

AnchoredLoops::Chain AnchoredLoops::ChainLegs(int start_heading, int max_turns) const {
  Chain chain(start_heading, legs_.size(), max_turns);
  const auto improve = [](Chain::Link& link, int64_t cost, int heading, int leg_turns) {
    if (cost < link.cost) link = {cost, heading, leg_turns};
  };
  chain.leaving[chain.Index(0, start_heading, 0)].cost = 0;
  for (size_t leg = 0; leg < legs_.size(); ++leg) {
    const Stop end = EndOf(leg);
    for (int from = 0; from < 4; ++from) {
      for (int to = 0; to < 4; ++to) {
        for (int i = 0; i <= max_leg_turns_; ++i) {
          const int64_t way = legs_[leg].ways[WayIndex(from, to, i)].cost;
          if (way == kNoWalk) continue;
          for (int k = i; k <= max_turns; ++k) {
            const int64_t before = chain.leaving[chain.Index(leg, from, k - i)].cost;
            if (before == kNoWalk) continue;
            improve(chain.arriving[chain.Index(leg + 1, to, k)], before + way, from, i);
          }
        }
      }
    }
    for (int from = 0; from < 4; ++from) {
      for (int to = 0; to < 4; ++to) {
        if (!MayPass(end.heading, from, to)) continue;
        const int turns = from == to ? 0 : 1;
        for (int k = turns; k <= max_turns; ++k) {
          improve(chain.leaving[chain.Index(leg + 1, to, k)],
                  chain.arriving[chain.Index(leg + 1, from, k - turns)].cost, from, 0);
        }
      }
    }
  }
  return chain;
}

std::vector<int> AnchoredLoops::TraceChain(const Chain& chain, int num_turns) const {
  std::vector<int> corners;  // from the last to the first
  int heading = chain.start_heading;
  for (size_t stop = legs_.size(); stop > 0; --stop) {
    const int arriving = chain.leaving[chain.Index(stop, heading, num_turns)].heading;
    if (arriving != heading) {
      corners.push_back(EndOf(stop - 1).vertex);
      --num_turns;
    }
    const Chain::Link& link = chain.arriving[chain.Index(stop, arriving, num_turns)];
    const Way& way = legs_[stop - 1].ways[WayIndex(link.heading, arriving, link.leg_turns)];
    corners.insert(corners.end(), way.corners.rbegin(), way.corners.rend());
    num_turns -= link.leg_turns;
    heading = link.heading;
  }
  std::reverse(corners.begin(), corners.end());
  return corners;
}

void AnchoredLoops::Find(LoopsByTurns& loops) const {
  if (stops_.empty()) return;
  const int max_turns = static_cast<int>(loops.size()) - 1;
  for (int start_heading = 0; start_heading < 4; ++start_heading) {
    const Chain chain = ChainLegs(start_heading, max_turns);
    for (int k = 0; k <= max_turns; ++k) {
      const int64_t cost = chain.leaving[chain.Index(legs_.size(), start_heading, k)].cost;
      CornerLoop& loop = loops[static_cast<size_t>(k)];
      if (cost == kNoWalk || cost >= loop.cost) continue;
      loop = {cost, TraceChain(chain, k)};
    }
  }
}

}  // namespace enfilade
