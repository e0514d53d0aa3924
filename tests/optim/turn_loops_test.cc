// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/turn_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include "tests/optim/grid_problems.h"

namespace enfilade {
namespace {

constexpr int64_t kNone = std::numeric_limits<int64_t>::max();
using Costs = std::vector<int64_t>;  // by number of turns; kNone where there is no loop

// The definition, as slowly as it reads: a graph whose nodes are (winding, vertex) and whose edges
// are all straight runs, in layers by the number of edges.
class LayeredTwin {
 public:
  explicit LayeredTwin(const GridLoopProblem& problem) : p_(problem), edges_(4 * NumVertices()) {
    int best_col = -1;
    for (int row = 0; row < p_.rows; ++row) {
      for (int col = 0; col < p_.cols; ++col) {
        if (!IsCore(p_, row, col) || col <= best_col) continue;
        ray_row_ = row;
        best_col = col;
      }
    }
    ray_col_ = best_col + 1;
    for (int v = 0; v < static_cast<int>(NumVertices()); ++v) {
      for (int heading = 0; heading < 4; ++heading) AddEdges(v, heading);
    }
  }

  // Every vertex is tried as the start of a horizontal edge.
  [[nodiscard]] Costs Solve(int max_turns) const {
    Costs best(static_cast<size_t>(max_turns) + 1, kNone);
    for (int v = 0; v < static_cast<int>(NumVertices()); ++v) {
      std::vector<Layer> layer = Start(v, 0);
      layer[1] = layer[2] = layer[3] = layer[0];
      for (int k = 1; k <= max_turns; ++k) {
        layer = Next(layer, k % 2 == 1, k % 2 == 0, Everywhere());
        const int64_t cost = std::min(At(layer[1], v, 1), At(layer[3], v, 1));
        if (k % 2 == 0) Improve(best[static_cast<size_t>(k)], cost);
      }
    }
    return best;
  }

  // Chains the legs between the lifted anchors.
  [[nodiscard]] Costs SolveAnchored(const TurnLoopProblem& problem) const {
    const std::vector<Stop> stops = Lift(problem);
    Costs best(static_cast<size_t>(problem.max_turns) + 1, kNone);
    for (int first = 0; first < 4; ++first) {
      if (!Allows(stops[0], first)) continue;
      std::vector<Costs> leaving(4, Costs(best.size(), kNone));
      leaving[static_cast<size_t>(first)][0] = 0;
      for (size_t s = 0; s + 1 < stops.size(); ++s) {
        leaving = Pass(Leg(problem, stops[s], stops[s + 1], leaving), stops[s + 1]);
      }
      for (size_t k = 0; k < best.size(); ++k)
        Improve(best[k], leaving[static_cast<size_t>(first)][k]);
    }
    return best;
  }

 private:
  static constexpr int kMaxWinding = 3;
  static constexpr int kNumLevels = 2 * kMaxWinding + 1;
  struct Edge {
    int to, level_change;
    int64_t cost;
  };
  struct Box {
    int low_row, high_row, low_col, high_col;
  };
  struct Stop {
    GridVertex at;
    int level;
    std::optional<GridHeading> heading;
    size_t guide_idx;
  };
  using Layer = Costs;  // by level and vertex

  [[nodiscard]] size_t NumVertices() const {
    return static_cast<size_t>((p_.rows + 1) * (p_.cols + 1));
  }
  [[nodiscard]] int VertexAt(GridVertex at) const { return at.row * (p_.cols + 1) + at.col; }
  [[nodiscard]] Box Everywhere() const { return {0, p_.rows, 0, p_.cols}; }
  [[nodiscard]] int64_t At(const Layer& layer, int v, int level) const {
    return layer[static_cast<size_t>(level + kMaxWinding) * NumVertices() + static_cast<size_t>(v)];
  }
  static void Improve(int64_t& best, int64_t cost) { best = std::min(best, cost); }
  static bool Allows(const Stop& stop, int heading) {
    return !stop.heading || static_cast<int>(*stop.heading) == heading;
  }

  void AddEdges(int v, int heading) {
    int row = v / (p_.cols + 1), col = v % (p_.cols + 1), level_change = 0;
    int64_t cost = 0;
    while (true) {
      const int next_row = row + kRowStep[heading], next_col = col + kColStep[heading];
      if (next_row < 0 || next_col < 0 || next_row > p_.rows || next_col > p_.cols) return;
      // The cell on the right of the step.
      const int right_row = heading == 0 || heading == 3 ? row - 1 : row;
      const int right_col = heading == 2 || heading == 3 ? col - 1 : col;
      const uint16_t step = p_.step_cost[p_.StepIndex(row, col, static_cast<GridHeading>(heading))];
      if (step == kBlockedStep || IsCore(p_, right_row, right_col)) return;
      cost += step;
      if (heading == 1 && row == ray_row_ && col >= ray_col_) ++level_change;
      if (heading == 3 && next_row == ray_row_ && col >= ray_col_) --level_change;
      row = next_row;
      col = next_col;
      edges_[static_cast<size_t>(v * 4 + heading)].push_back(
          {VertexAt({row, col}), level_change, cost});
    }
  }

  // By heading of the last edge; the start counts as each.
  [[nodiscard]] std::vector<Layer> Start(int v, int level) const {
    std::vector<Layer> layer(4, Layer(NumVertices() * kNumLevels, kNone));
    layer[0][static_cast<size_t>(level + kMaxWinding) * NumVertices() + static_cast<size_t>(v)] = 0;
    return layer;
  }

  [[nodiscard]] std::vector<Layer> Next(const std::vector<Layer>& layer, bool horizontal,
                                        bool vertical, Box box) const {
    std::vector<Layer> next(4, Layer(layer[0].size(), kNone));
    for (size_t node = 0; node < layer[0].size(); ++node) {
      const int level = static_cast<int>(node / NumVertices());
      const size_t v = node % NumVertices();
      for (size_t heading = 0; heading < 4; ++heading) {
        if (!(heading % 2 == 0 ? horizontal : vertical)) continue;
        const int64_t from =
            std::min(layer[(heading + 1) % 4][node], layer[(heading + 3) % 4][node]);
        if (from == kNone) continue;
        for (const Edge& edge : edges_[v * 4 + heading]) {
          const int row = edge.to / (p_.cols + 1), col = edge.to % (p_.cols + 1);
          const int next_level = level + edge.level_change;
          if (next_level < 0 || next_level >= kNumLevels || row < box.low_row ||
              row > box.high_row || col < box.low_col || col > box.high_col) {
            continue;
          }
          Improve(next[heading][static_cast<size_t>(next_level) * NumVertices() +
                                static_cast<size_t>(edge.to)],
                  from + edge.cost);
        }
      }
    }
    return next;
  }

  // Anchors with their levels, the first once more at the end. Those that follow each other at the
  // same place and do not contradict each other are one.
  [[nodiscard]] std::vector<Stop> Lift(const TurnLoopProblem& problem) const {
    const size_t n = problem.guide.size();
    std::vector<int> level{0};
    for (size_t i = 0; i < n; ++i) {
      GridVertex a = problem.guide[i];
      const GridVertex b = problem.guide[(i + 1) % n];
      level.push_back(level.back());
      while (a.row != b.row) {
        const int next = a.row + (b.row > a.row ? 1 : -1);
        if (a.col >= ray_col_ && std::min(a.row, next) == ray_row_) level.back() += next - a.row;
        a.row = next;
      }
    }
    std::vector<Stop> stops;
    const auto merges = [](Stop& stop, const Stop& next, int level_change) {
      if (!(stop.at == next.at) || next.level - stop.level != level_change) return false;
      if (stop.heading && next.heading && *stop.heading != *next.heading) return false;
      if (next.heading) stop.heading = next.heading;
      return true;
    };
    for (const GridAnchor& anchor : problem.anchors) {
      const size_t i = static_cast<size_t>(anchor.guide_idx);
      const Stop stop{problem.guide[i], level[i], anchor.heading, i};
      if (stops.empty() || !merges(stops.back(), stop, 0)) stops.push_back(stop);
    }
    if (stops.size() > 1 && merges(stops.front(), stops.back(), 1)) stops.pop_back();
    Stop last = stops.front();
    last.level += 1;
    last.guide_idx += n;
    stops.push_back(last);
    return stops;
  }

  // Costs of arriving at `to` by heading and number of turns.
  [[nodiscard]] std::vector<Costs> Leg(const TurnLoopProblem& problem, const Stop& from,
                                       const Stop& to, const std::vector<Costs>& leaving) const {
    Box box{p_.rows, 0, p_.cols, 0};
    for (size_t i = from.guide_idx; i <= to.guide_idx; ++i) {
      const GridVertex at = problem.guide[i % problem.guide.size()];
      box.low_row = std::min(box.low_row, at.row - problem.leg_margin_cells);
      box.high_row = std::max(box.high_row, at.row + problem.leg_margin_cells);
      box.low_col = std::min(box.low_col, at.col - problem.leg_margin_cells);
      box.high_col = std::max(box.high_col, at.col + problem.leg_margin_cells);
    }
    std::vector<Costs> arriving(4, Costs(leaving[0].size(), kNone));
    for (size_t first = 0; first < 4; ++first) {
      if (!Allows(from, static_cast<int>(first))) continue;
      std::vector<Layer> layer = Start(VertexAt(from.at), from.level);
      std::swap(layer[0], layer[(first + 1) % 4]);
      for (int i = 0; i <= problem.max_leg_turns; ++i) {
        std::vector<Layer> next = Next(layer, true, true, box);
        // The layer before the first edge may leave with one heading only.
        if (i == 0) std::fill(next[(first + 2) % 4].begin(), next[(first + 2) % 4].end(), kNone);
        layer = std::move(next);
        for (size_t last = 0; last < 4; ++last) {
          const int64_t way = At(layer[last], VertexAt(to.at), to.level);
          if (!Allows(to, static_cast<int>(last)) || way == kNone) continue;
          for (size_t k = static_cast<size_t>(i); k < leaving[0].size(); ++k) {
            const int64_t before = leaving[first][k - static_cast<size_t>(i)];
            if (before != kNone) Improve(arriving[last][k], before + way);
          }
        }
      }
    }
    return arriving;
  }

  [[nodiscard]] std::vector<Costs> Pass(const std::vector<Costs>& arriving, const Stop& at) const {
    std::vector<Costs> leaving(4, Costs(arriving[0].size(), kNone));
    for (size_t heading = 0; heading < 4; ++heading) {
      if (!Allows(at, static_cast<int>(heading))) continue;
      leaving[heading] = arriving[heading];
      if (at.heading) continue;
      for (size_t k = 1; k < leaving[heading].size(); ++k) {
        Improve(leaving[heading][k],
                std::min(arriving[(heading + 1) % 4][k - 1], arriving[(heading + 3) % 4][k - 1]));
      }
    }
    return leaving;
  }

  const GridLoopProblem& p_;
  int ray_row_ = 0, ray_col_ = 0;
  std::vector<std::vector<Edge>> edges_;  // by vertex and heading
};

struct Walked {
  GridVertex at;
  int heading;
};

std::vector<Walked> StepsOf(const std::vector<GridVertex>& ring) {
  std::vector<Walked> steps;
  for (size_t i = 0; i < ring.size(); ++i) {
    GridVertex a = ring[i];
    const GridVertex b = ring[(i + 1) % ring.size()];
    const int heading = b.col > a.col ? 0 : b.row > a.row ? 1 : b.col < a.col ? 2 : 3;
    for (; !(a == b); a = {a.row + kRowStep[heading], a.col + kColStep[heading]}) {
      steps.push_back({a, heading});
    }
  }
  return steps;
}

// Corners at right angles; steps that are not blocked, whose costs sum up; once round every core
// cell; simple as it says; through all anchors.
void ExpectValidLoop(const TurnLoopProblem& problem, const TurnLoop& loop) {
  const GridLoopProblem& p = problem.grid;
  ASSERT_EQ(loop.ring.size(), static_cast<size_t>(loop.num_turns));
  for (size_t i = 0; i < loop.ring.size(); ++i) {
    const GridVertex a = loop.ring[i], b = loop.ring[(i + 1) % loop.ring.size()],
                     c = loop.ring[(i + 2) % loop.ring.size()];
    ASSERT_TRUE((a.row == b.row) != (a.col == b.col));
    ASSERT_TRUE((a.row == b.row) != (b.row == c.row)) << "no corner";
  }
  const std::vector<Walked> steps = StepsOf(loop.ring);
  int64_t cost = 0;
  std::set<std::pair<int, int>> visited;
  for (const auto& [at, heading] : steps) {
    const uint16_t step =
        p.step_cost[p.StepIndex(at.row, at.col, static_cast<GridHeading>(heading))];
    ASSERT_NE(step, kBlockedStep);
    cost += step;
    visited.insert({at.row, at.col});
  }
  EXPECT_EQ(cost, loop.cost);
  EXPECT_EQ(loop.is_simple, visited.size() == steps.size());
  for (int row = 0; row < p.rows; ++row) {
    for (int col = 0; col < p.cols; ++col) {
      if (!IsCore(p, row, col)) continue;
      int winding = 0;
      for (const auto& [at, heading] : steps) {
        if (at.col <= col) continue;
        winding += heading == 1 && at.row == row;
        winding -= heading == 3 && at.row == row + 1;
      }
      EXPECT_EQ(winding, 1) << row << ' ' << col;
    }
  }
  for (const GridAnchor& anchor : problem.anchors) {
    const GridVertex at = problem.guide[static_cast<size_t>(anchor.guide_idx)];
    EXPECT_TRUE(visited.count({at.row, at.col}) != 0);
  }
}

Costs CostsOf(const TurnLoopProblem& problem, const TurnLoopReport& report) {
  Costs costs(static_cast<size_t>(problem.max_turns) + 1, kNone);
  int last = 0;
  for (const TurnLoop& loop : report.loops) {
    EXPECT_GT(loop.num_turns, last);
    EXPECT_LE(loop.num_turns, problem.max_turns);
    last = loop.num_turns;
    costs[static_cast<size_t>(loop.num_turns)] = loop.cost;
  }
  EXPECT_EQ(report.outcome == GridLoopOutcome::kFound, !report.loops.empty());
  return costs;
}

void ExpectEqualsTwin(const TurnLoopProblem& problem) {
  const TurnLoopReport report = FindLoopsByTurns(problem);
  const LayeredTwin twin(problem.grid);
  EXPECT_EQ(CostsOf(problem, report),
            problem.anchors.empty() ? twin.Solve(problem.max_turns) : twin.SolveAnchored(problem));
  for (const TurnLoop& loop : report.loops) {
    SCOPED_TRACE(loop.num_turns);
    ExpectValidLoop(problem, loop);
  }
}

// A closed walk once round the core with vertices at every step, and some spikes.
std::vector<GridVertex> MakeGuide(const GridLoopProblem& p, std::mt19937& random) {
  GridLoopProblem other = p;
  for (uint16_t& cost : other.step_cost) cost = static_cast<uint16_t>(random() % 10);
  std::vector<GridVertex> guide;
  other.margin_cells = 1 << 20;
  for (const auto& [at, heading] : StepsOf(FindShortestLoop(other).ring)) {
    guide.push_back(at);
    if (random() % 10 != 0) continue;
    GridVertex tip = at;
    tip.row = static_cast<int>(random() % static_cast<unsigned>(p.rows + 1));
    guide.insert(guide.end(), {tip, at});
  }
  return guide;
}

void AddRandomAnchors(TurnLoopProblem& problem, std::mt19937& random) {
  problem.guide = MakeGuide(problem.grid, random);
  const int size = static_cast<int>(problem.guide.size());
  std::set<int> places;
  const int num_anchors = 1 + static_cast<int>(random() % 5);
  for (int i = 0; i < num_anchors; ++i)
    places.insert(static_cast<int>(random() % static_cast<unsigned>(size)));
  for (const int place : places) {
    GridAnchor anchor{place, std::nullopt};
    const GridVertex a = problem.guide[static_cast<size_t>(place)],
                     b = problem.guide[static_cast<size_t>((place + 1) % size)];
    const int along = b.col > a.col ? 0 : b.row > a.row ? 1 : b.col < a.col ? 2 : 3;
    if (random() % 2 == 0) anchor.heading = static_cast<GridHeading>(along);
    if (random() % 20 == 0) anchor.heading = static_cast<GridHeading>(random() % 4);
    problem.anchors.push_back(anchor);
  }
}

TEST(TurnLoops, KnowsTheCostOfEveryNumberOfCorners) {
  TurnLoopProblem problem;
  problem.grid = ParseCore({"......", ".##...", ".##...", ".####.", ".####.", "......"}, 2, 1);
  problem.max_turns = 8;
  const TurnLoopReport report = FindLoopsByTurns(problem);
  EXPECT_EQ(CostsOf(problem, report),
            (Costs{kNone, kNone, kNone, kNone, 32, kNone, 32, kNone, 32}));
}

TEST(TurnLoops, EqualsTheTwinOnRandomGrids) {
  std::mt19937 random(3);
  for (int i = 0; i < 650; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = MakeRandomProblem(5, random);
    problem.max_turns = 12;
    ExpectEqualsTwin(problem);
    if (HasFailure()) return;
  }
}

TEST(TurnLoops, EqualsTheTwinOnFoldedWalls) {
  std::mt19937 random(4);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = MakeFoldedProblem(7, 30, random);
    problem.max_turns = 12;
    ExpectEqualsTwin(problem);
    if (HasFailure()) return;
  }
}

TEST(TurnLoops, EqualsTheTwinWithAnchors) {
  std::mt19937 random(5);
  int num_found = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = i % 3 == 0 ? MakeFoldedProblem(7, 30, random) : MakeRandomProblem(5, random);
    problem.max_turns = 20;
    problem.max_leg_turns = 1 + static_cast<int>(random() % 8);
    problem.leg_margin_cells = static_cast<int>(random() % 4);
    if (random() % 2 == 0) problem.leg_margin_cells = 40;
    AddRandomAnchors(problem, random);
    ExpectEqualsTwin(problem);
    num_found += FindLoopsByTurns(problem).outcome == GridLoopOutcome::kFound;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_found, 100);
}

// More turns: up to two levels above the first.
TEST(TurnLoops, EqualsTheTwinWithManyTurns) {
  std::mt19937 random(8);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = MakeFoldedProblem(7, 50, random);
    problem.max_turns = 24;
    ExpectEqualsTwin(problem);
    if (HasFailure()) return;
  }
}

TEST(TurnLoops, LeastCostWithTurnsIsThatOfTheShortestLoop) {
  std::mt19937 random(6);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = i % 2 == 0 ? MakeRandomProblem(12, random) : MakeFoldedProblem(12, 50, random);
    const TurnLoopReport report = FindLoopsByTurns(problem);
    int64_t least = kNone;
    for (const TurnLoop& loop : report.loops)
      least = std::min(least, loop.cost + problem.grid.turn_cost * loop.num_turns);
    const GridLoopReport shortest = FindShortestLoop(problem.grid);
    EXPECT_EQ(report.outcome, shortest.outcome);
    EXPECT_EQ(least, shortest.outcome == GridLoopOutcome::kFound ? shortest.cost : kNone);
    for (const TurnLoop& loop : report.loops) ExpectValidLoop(problem, loop);
    if (HasFailure()) return;
  }
}

// A free corridor that winds round the core twice and comes back beside itself.
TEST(TurnLoops, FollowsADoubleSpiral) {
  TurnLoopProblem problem;
  problem.grid = MakeProblem(16, 16, 1000, 1);
  problem.grid.core[8 * 16 + 7] = 1;
  const std::vector<GridVertex> ring = {{7, 6},   {7, 10}, {11, 10}, {11, 4},  {4, 4},  {4, 13},
                                        {13, 13}, {13, 2}, {12, 2},  {12, 12}, {5, 12}, {5, 5},
                                        {10, 5},  {10, 9}, {9, 9},   {9, 6}};
  for (size_t i = 0; i < ring.size(); ++i)
    SetEdge(problem.grid, ring[i], ring[(i + 1) % ring.size()], 0);
  const TurnLoopReport report = FindLoopsByTurns(problem);
  const auto loop = std::find_if(report.loops.begin(), report.loops.end(),
                                 [](const TurnLoop& l) { return l.num_turns == 16; });
  ASSERT_NE(loop, report.loops.end());
  EXPECT_EQ(loop->cost, 0);
  EXPECT_TRUE(loop->is_simple);
  ExpectValidLoop(problem, *loop);
}

// By number of corners the cheapest of all cycles of the grid that have the core inside, each
// found as a path from its lowest vertex.
class CycleEnumeration {
 public:
  CycleEnumeration(const GridLoopProblem& problem, int max_turns)
      : p_(problem), best_(static_cast<size_t>(max_turns) + 1, kNone) {}

  Costs Solve() {
    for (int v = 0; v < (p_.rows + 1) * (p_.cols + 1); ++v) {
      is_visited_.assign(static_cast<size_t>((p_.rows + 1) * (p_.cols + 1)), false);
      start_ = v;
      Extend({v / (p_.cols + 1), v % (p_.cols + 1)}, 0);
    }
    return best_;
  }

 private:
  void Extend(GridVertex at, int64_t cost) {
    for (int heading = 0; heading < 4; ++heading) {
      const GridVertex next{at.row + kRowStep[heading], at.col + kColStep[heading]};
      if (next.row < 0 || next.col < 0 || next.row > p_.rows || next.col > p_.cols) continue;
      const uint16_t step =
          p_.step_cost[p_.StepIndex(at.row, at.col, static_cast<GridHeading>(heading))];
      const int v = next.row * (p_.cols + 1) + next.col;
      if (step == kBlockedStep || v < start_ || is_visited_[static_cast<size_t>(v)]) continue;
      is_visited_[static_cast<size_t>(v)] = true;
      steps_.push_back({at, heading});
      if (v == start_) {
        Close(cost + step);
      } else {
        Extend(next, cost + step);
      }
      steps_.pop_back();
      is_visited_[static_cast<size_t>(v)] = false;
    }
  }

  void Close(int64_t cost) {
    size_t num_turns = 0;
    for (size_t i = 0; i < steps_.size(); ++i) {
      const int change = steps_[(i + 1) % steps_.size()].heading - steps_[i].heading;
      if (change % 4 == 2 || change % 4 == -2) return;  // there and back
      num_turns += change != 0;
    }
    if (num_turns < best_.size() && cost < best_[num_turns] && HoldsCore()) best_[num_turns] = cost;
  }

  [[nodiscard]] bool HoldsCore() const {
    for (int row = 0; row < p_.rows; ++row) {
      for (int col = 0; col < p_.cols; ++col) {
        if (!IsCore(p_, row, col)) continue;
        int winding = 0;
        for (const auto& [at, heading] : steps_) {
          winding += heading == 1 && at.row == row && at.col > col;
          winding -= heading == 3 && at.row == row + 1 && at.col > col;
        }
        if (winding != 1) return false;
      }
    }
    return true;
  }

  const GridLoopProblem& p_;
  Costs best_;
  int start_ = 0;
  std::vector<bool> is_visited_;
  std::vector<Walked> steps_;
};

TEST(TurnLoops, UntanglesLoopsThatCrossThemselves) {
  std::mt19937 random(9);
  int num_crossing = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = MakeProblem(4, 4, 0, 1);
    for (uint16_t& cost : problem.grid.step_cost) {
      cost = static_cast<uint16_t>(random() % 4 == 0 ? random() % 100 : random() % 5);
    }
    AddRandomCore(problem.grid, 1, random);
    problem.max_turns = 12;
    const TurnLoopReport crossing = FindLoopsByTurns(problem);
    problem.max_untangling_solves = 100000;
    const TurnLoopReport report = FindLoopsByTurns(problem);
    const Costs expected = CycleEnumeration(problem.grid, problem.max_turns).Solve();
    ASSERT_EQ(report.loops.size(), crossing.loops.size());
    for (size_t l = 0; l < report.loops.size(); ++l) {
      const TurnLoop& loop = report.loops[l];
      ExpectValidLoop(problem, loop);
      EXPECT_EQ(loop.is_simple, expected[static_cast<size_t>(loop.num_turns)] != kNone);
      const int64_t cost =
          loop.is_simple ? expected[static_cast<size_t>(loop.num_turns)] : crossing.loops[l].cost;
      EXPECT_EQ(loop.cost, cost) << loop.num_turns;
      num_crossing += !crossing.loops[l].is_simple;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(num_crossing, 30);
}

TEST(TurnLoops, UntanglesLoopsWithAnchors) {
  std::mt19937 random(10);
  int num_crossing = 0, num_untangled = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    problem.grid = MakeRandomProblem(5, random);
    problem.max_turns = 16;
    AddRandomAnchors(problem, random);
    const TurnLoopReport crossing = FindLoopsByTurns(problem);
    problem.max_untangling_solves = 20;
    const TurnLoopReport report = FindLoopsByTurns(problem);
    ASSERT_EQ(report.loops.size(), crossing.loops.size());
    for (size_t l = 0; l < report.loops.size(); ++l) {
      ExpectValidLoop(problem, report.loops[l]);
      EXPECT_GE(report.loops[l].cost, crossing.loops[l].cost);
      num_crossing += !crossing.loops[l].is_simple;
      num_untangled += !crossing.loops[l].is_simple && report.loops[l].is_simple;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(num_crossing, 0);
  EXPECT_GT(num_untangled, 0);
}

TEST(TurnLoops, SaysWhyThereIsNone) {
  TurnLoopProblem problem;
  problem.grid = MakeProblem(0, 0, 1, 1);
  EXPECT_EQ(FindLoopsByTurns(problem).outcome, GridLoopOutcome::kEmptyCore);
  problem.grid = ParseCore({"#..", ".#."}, 1, 1);
  EXPECT_EQ(FindLoopsByTurns(problem).outcome, GridLoopOutcome::kDisconnectedCore);
  problem.grid = ParseCore({"...", ".#.", "..."}, kBlockedStep, 1);
  EXPECT_EQ(FindLoopsByTurns(problem).outcome, GridLoopOutcome::kNoRoute);
  problem.grid = ParseCore({"...", ".#.", "..."}, 1, 1);
  problem.max_turns = 3;
  EXPECT_EQ(FindLoopsByTurns(problem).outcome, GridLoopOutcome::kNoRoute);
}

class TurnLoopsWithAnchors : public testing::Test {
 protected:
  TurnLoopsWithAnchors() {
    problem_.grid = ParseCore({".....", ".....", "..#..", ".....", "....."}, 1, 1);
    problem_.guide = {{0, 0}, {0, 2}, {0, 5}, {2, 5}, {5, 5}, {5, 0}};
    problem_.max_turns = 12;
  }
  [[nodiscard]] TurnLoop LoopWith(int num_turns) const {
    for (const TurnLoop& loop : FindLoopsByTurns(problem_).loops) {
      if (loop.num_turns == num_turns) return loop;
    }
    return {};
  }
  TurnLoopProblem problem_;
};

TEST_F(TurnLoopsWithAnchors, PassStraightOnWithoutATurn) {
  problem_.anchors = {{1, GridHeading::kEast}};
  const TurnLoop loop = LoopWith(4);
  EXPECT_EQ(loop.cost, 2 * (2 + 3));
  EXPECT_EQ(loop.ring.size(), 4u);
  ExpectValidLoop(problem_, loop);
}

TEST_F(TurnLoopsWithAnchors, TurnAtOneThatHasNoHeading) {
  problem_.anchors = {{0, std::nullopt}, {2, std::nullopt}, {4, std::nullopt}, {5, std::nullopt}};
  const TurnLoop loop = LoopWith(4);
  EXPECT_EQ(loop.cost, 20);
  ExpectValidLoop(problem_, loop);
}

TEST_F(TurnLoopsWithAnchors, DoNotTurnWhereAHeadingIsGiven) {
  problem_.anchors = {{0, GridHeading::kEast}};  // in the grid's corner, where east never leads on
  EXPECT_EQ(FindLoopsByTurns(problem_).outcome, GridLoopOutcome::kNoRoute);
}

TEST_F(TurnLoopsWithAnchors, GoTheGuidesWayRoundTheCore) {
  // From the south side to the east side and back to the south: the last leg goes round.
  problem_.anchors = {{1, GridHeading::kEast}, {3, GridHeading::kNorth}};
  const TurnLoop loop = LoopWith(4);
  ExpectValidLoop(problem_, loop);
  EXPECT_EQ(loop.cost, 2 * (3 + 4));
  problem_.max_leg_turns = 2;
  EXPECT_EQ(LoopWith(4).cost, 0);  // the last leg needs three turns
}

TEST_F(TurnLoopsWithAnchors, ThatContradictEachOtherHaveNoLoop) {
  // The same place with opposite headings: only a detour could come back to it.
  problem_.anchors = {{1, GridHeading::kEast}, {1, GridHeading::kWest}};
  problem_.max_leg_turns = 1;
  EXPECT_EQ(FindLoopsByTurns(problem_).outcome, GridLoopOutcome::kNoRoute);
  problem_.grid.margin_cells = 1;  // the anchor lies out of the box
  problem_.anchors = {{1, GridHeading::kEast}};
  EXPECT_EQ(FindLoopsByTurns(problem_).outcome, GridLoopOutcome::kNoRoute);
}

// Whatever comes: grids of one row, cores everywhere or nowhere, walls everywhere, corridors of one
// cell, anchors at random.
TEST(TurnLoops, NeverFailsOnOddProblems) {
  std::mt19937 random(11);
  const auto draw = [&](int end) {
    return static_cast<int>(random() % static_cast<unsigned>(end));
  };
  int num_found = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    TurnLoopProblem problem;
    GridLoopProblem& grid = problem.grid;
    grid = MakeProblem(draw(3) == 0 ? draw(2) : draw(9), draw(3) == 0 ? draw(2) : draw(9),
                       draw(4) == 0 ? kBlockedStep : static_cast<uint16_t>(1 + draw(50)), 1);
    grid.margin_cells = draw(3) == 0 ? draw(3) : 100;
    for (uint8_t& cell : grid.core) cell = draw(8) == 0;
    if (draw(2) == 0) std::fill(grid.core.begin(), grid.core.end(), uint8_t{draw(2) == 0});
    if (draw(3) != 0 && !grid.core.empty()) AddRandomCore(grid, draw(20), random);
    for (int run = draw(20); run > 0; --run) {
      const GridVertex a{draw(grid.rows + 1), draw(grid.cols + 1)};
      const GridVertex b = draw(2) == 0 ? GridVertex{draw(grid.rows + 1), a.col}
                                        : GridVertex{a.row, draw(grid.cols + 1)};
      SetEdge(grid, a, b, draw(4) == 0 ? kBlockedStep : static_cast<uint16_t>(draw(3)));
    }
    problem.max_turns = draw(30);
    problem.max_leg_turns = draw(10);
    problem.leg_margin_cells = draw(5);
    problem.max_untangling_solves = draw(3);
    if (draw(2) == 0) {
      problem.guide = MakeGuide(grid, random);
      if (problem.guide.empty()) problem.guide = {{0, 0}};
      for (int place = draw(3); place < static_cast<int>(problem.guide.size()); place += draw(5)) {
        problem.anchors.push_back({place, std::nullopt});
        if (draw(3) == 0) problem.anchors.back().heading = static_cast<GridHeading>(draw(4));
        if (problem.anchors.size() > 20) break;
      }
    }
    const TurnLoopReport report = FindLoopsByTurns(problem);
    for (const TurnLoop& loop : report.loops) ExpectValidLoop(problem, loop);
    num_found += !report.loops.empty();
    if (HasFailure()) return;
  }
  EXPECT_GT(num_found, 100);
}

}  // namespace
}  // namespace enfilade
