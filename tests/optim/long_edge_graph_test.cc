// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The solvers beside Dijkstra of Boost.Graph on the explicit graph of long straight edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <limits>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "enfilade/optim/grid_loop.h"
#include "enfilade/optim/turn_loops.h"
#include "tests/optim/grid_problems.h"

namespace enfilade {
namespace {

using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, int>;
constexpr int kNumLevels = 5;  // of windings, the middle one is that of the start

int NumVertices(const GridLoopProblem& p) { return (p.rows + 1) * (p.cols + 1); }

// The row and the first column of the ray, east of the easternmost core cell.
GridVertex RayOf(const GridLoopProblem& p) {
  GridVertex ray{0, -1};
  for (int row = 0; row < p.rows; ++row) {
    for (int col = 0; col < p.cols; ++col) {
      if (IsCore(p, row, col) && col >= ray.col) ray = {row, col + 1};
    }
  }
  return ray;
}

// Nodes are (winding, vertex), edges all straight runs that do not enter the core; an edge costs a
// turn and its steps.
Graph MakeLongEdgeGraph(const GridLoopProblem& p) {
  const GridVertex ray = RayOf(p);
  std::vector<std::pair<int, int>> edges;
  std::vector<int> costs;
  for (int node = 0; node < kNumLevels * NumVertices(p); ++node) {
    for (int heading = 0; heading < 4; ++heading) {
      int level = node / NumVertices(p), cost = p.turn_cost;
      int row = node % NumVertices(p) / (p.cols + 1), col = node % NumVertices(p) % (p.cols + 1);
      while (true) {
        const int next_row = row + kRowStep[heading], next_col = col + kColStep[heading];
        if (next_row < 0 || next_col < 0 || next_row > p.rows || next_col > p.cols) break;
        const int r = std::min(row, next_row), c = std::min(col, next_col);
        const bool is_horizontal = row == next_row;
        const bool enters_core =
            IsCore(p, r, c) && IsCore(p, is_horizontal ? r - 1 : r, is_horizontal ? c : c - 1);
        const uint16_t step = p.step_cost[p.StepIndex(row, col, static_cast<GridHeading>(heading))];
        if (step == kBlockedStep || enters_core) break;
        if (!is_horizontal && r == ray.row && c >= ray.col) level += next_row - row;
        if (level < 0 || level == kNumLevels) break;
        cost += step;
        row = next_row;
        col = next_col;
        edges.emplace_back(node, level * NumVertices(p) + row * (p.cols + 1) + col);
        costs.push_back(cost);
      }
    }
  }
  return {boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(), costs.begin(),
          static_cast<size_t>(kNumLevels * NumVertices(p))};
}

// Least cost over all first corners; none when there is no loop.
std::optional<int64_t> SolveWithBoost(const GridLoopProblem& p) {
  const Graph graph = MakeLongEdgeGraph(p);
  int best = std::numeric_limits<int>::max();
  std::vector<int> distance(boost::num_vertices(graph));
  const auto index = boost::get(boost::vertex_index, graph);
  for (int v = 0; v < NumVertices(p); ++v) {
    const int start = kNumLevels / 2 * NumVertices(p) + v;
    boost::dijkstra_shortest_paths(
        graph, static_cast<size_t>(start),
        boost::weight_map(boost::get(boost::edge_bundle, graph))
            .distance_map(boost::make_iterator_property_map(distance.begin(), index)));
    best = std::min(best, distance[static_cast<size_t>(start + NumVertices(p))]);
  }
  return best == std::numeric_limits<int>::max() ? std::nullopt : std::optional<int64_t>(best);
}

void ExpectEqualsBoost(const GridLoopProblem& problem) {
  const std::optional<int64_t> expected = SolveWithBoost(problem);
  const GridLoopReport shortest = FindShortestLoop(problem);
  ASSERT_EQ(shortest.outcome == GridLoopOutcome::kFound, expected.has_value());
  TurnLoopProblem by_turns;
  by_turns.grid = problem;
  const TurnLoopReport report = FindLoopsByTurns(by_turns);
  ASSERT_EQ(report.outcome, shortest.outcome);
  if (!expected) return;
  EXPECT_EQ(shortest.cost, *expected);
  int64_t least = std::numeric_limits<int64_t>::max();
  for (const TurnLoop& loop : report.loops)
    least = std::min(least, loop.cost + int64_t{problem.turn_cost} * loop.num_turns);
  EXPECT_EQ(least, *expected);
}

TEST(LongEdgeGraph, HasTheSameShortestLoopsOnRandomGrids) {
  std::mt19937 random(12);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    ExpectEqualsBoost(MakeRandomProblem(6, random));
  }
}

TEST(LongEdgeGraph, HasTheSameShortestLoopsBetweenFoldedWalls) {
  std::mt19937 random(13);
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    ExpectEqualsBoost(MakeFoldedProblem(8, 40, random));
  }
}

}  // namespace
}  // namespace enfilade
