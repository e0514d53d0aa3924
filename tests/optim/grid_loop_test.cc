// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/grid_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <random>
#include <set>
#include <tuple>

#include "tests/optim/grid_problems.h"

namespace enfilade {
namespace {

constexpr int64_t kNone = std::numeric_limits<int64_t>::max();

// The definition, as slowly as it reads: a graph whose nodes are (vertex, winding) and whose edges
// are all straight runs, each costing a turn and its steps; every vertex is tried as first corner.
class BruteForce {
 public:
  explicit BruteForce(const GridLoopProblem& problem) : p_(problem) {
    int best_col = -1;
    for (int row = 0; row < p_.rows; ++row) {
      for (int col = 0; col < p_.cols; ++col) {
        if (IsCore(p_, row, col) && col > best_col)
          std::tie(ray_row_, best_col) = std::tuple(row, col);
      }
    }
    ray_col_ = best_col + 1;
  }

  int64_t Solve() const {
    int64_t best = kNone;
    for (int v = 0; v < NumVertices(); ++v) best = std::min(best, From(v, best));
    return best;
  }

 private:
  static constexpr int kMaxWinding = 3;

  int NumVertices() const { return (p_.rows + 1) * (p_.cols + 1); }

  int64_t From(int start, int64_t limit) const {
    const int num_levels = 2 * kMaxWinding + 1;
    std::vector<int64_t> distance(static_cast<size_t>(NumVertices() * num_levels), kNone);
    using Item = std::pair<int64_t, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const int source = kMaxWinding * NumVertices() + start;
    distance[static_cast<size_t>(source)] = 0;
    queue.push({0, source});
    while (!queue.empty()) {
      const auto [d, node] = queue.top();
      queue.pop();
      if (d >= limit) return kNone;
      if (node == source + NumVertices()) return d;
      if (d != distance[static_cast<size_t>(node)]) continue;
      for (int heading = 0; heading < 4; ++heading) {
        int level = node / NumVertices(), v = node % NumVertices();
        int row = v / (p_.cols + 1), col = v % (p_.cols + 1);
        int64_t cost = d + p_.turn_cost;
        while (true) {
          const int next_row = row + kRowStep[heading], next_col = col + kColStep[heading];
          if (next_row < 0 || next_col < 0 || next_row > p_.rows || next_col > p_.cols) break;
          const uint16_t step =
              p_.step_cost[p_.StepIndex(row, col, static_cast<GridHeading>(heading))];
          if (step == kBlockedStep || RunsThroughCore(row, col, heading)) break;
          cost += step;
          if (heading == 1 && row == ray_row_ && col >= ray_col_) ++level;
          if (heading == 3 && next_row == ray_row_ && col >= ray_col_) --level;
          if (level < 0 || level >= num_levels) break;
          row = next_row;
          col = next_col;
          const int next = level * NumVertices() + row * (p_.cols + 1) + col;
          if (cost < distance[static_cast<size_t>(next)]) {
            distance[static_cast<size_t>(next)] = cost;
            queue.push({cost, next});
          }
        }
      }
    }
    return kNone;
  }

  bool RunsThroughCore(int row, int col, int heading) const {
    const int r = std::min(row, row + kRowStep[heading]),
              c = std::min(col, col + kColStep[heading]);
    const bool is_horizontal = kRowStep[heading] == 0;
    return IsCore(p_, r, c) && IsCore(p_, is_horizontal ? r - 1 : r, is_horizontal ? c : c - 1);
  }

  const GridLoopProblem& p_;
  int ray_row_ = 0, ray_col_ = 0;
};

int64_t CostOf(const GridLoopProblem& p, const std::vector<GridVertex>& ring) {
  int64_t cost = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    GridVertex a = ring[i];
    const GridVertex b = ring[(i + 1) % ring.size()];
    const int dr = (b.row > a.row) - (b.row < a.row), dc = (b.col > a.col) - (b.col < a.col);
    const int heading = dc > 0 ? 0 : dr > 0 ? 1 : dc < 0 ? 2 : 3;
    for (; !(a == b); a = {a.row + dr, a.col + dc}) {
      cost += p.step_cost[p.StepIndex(a.row, a.col, static_cast<GridHeading>(heading))];
    }
    cost += p.turn_cost;
  }
  return cost;
}

// Counter-clockwise, axis-parallel, alternating, visiting no vertex twice, with the whole core
// inside.
void ExpectValidRing(const GridLoopProblem& p, const std::vector<GridVertex>& ring) {
  ASSERT_GE(ring.size(), 4u);
  std::set<std::pair<int, int>> visited;
  int64_t twice_area = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    GridVertex a = ring[i];
    const GridVertex b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
    ASSERT_TRUE((a.row == b.row) != (a.col == b.col));
    ASSERT_TRUE((a.row == b.row) != (b.row == c.row)) << "collinear corner";
    twice_area += int64_t{a.col} * b.row - int64_t{b.col} * a.row;
    const int dr = (b.row > a.row) - (b.row < a.row), dc = (b.col > a.col) - (b.col < a.col);
    for (; !(a == b); a = {a.row + dr, a.col + dc}) {
      ASSERT_TRUE(visited.insert({a.row, a.col}).second) << "vertex visited twice";
    }
  }
  EXPECT_GT(twice_area, 0);
  const auto is_inside = [&](int row, int col) {
    bool inside = false;
    for (size_t i = 0; i < ring.size(); ++i) {
      const GridVertex a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a.col == b.col && a.col > col && row >= std::min(a.row, b.row) &&
          row < std::max(a.row, b.row)) {
        inside = !inside;
      }
    }
    return inside;
  };
  for (int row = 0; row < p.rows; ++row) {
    for (int col = 0; col < p.cols; ++col) {
      EXPECT_TRUE(!IsCore(p, row, col) || is_inside(row, col)) << row << ' ' << col;
    }
  }
}

void ExpectEqualsBruteForce(const GridLoopProblem& problem) {
  const GridLoopReport report = FindShortestLoop(problem);
  const int64_t expected = BruteForce(problem).Solve();
  if (expected == kNone) {
    EXPECT_EQ(report.outcome, GridLoopOutcome::kNoRoute);
    return;
  }
  ASSERT_EQ(report.outcome, GridLoopOutcome::kFound);
  EXPECT_EQ(report.cost, expected);
  EXPECT_EQ(CostOf(problem, report.ring), report.cost);
  ExpectValidRing(problem, report.ring);
}

TEST(GridLoop, GoesRoundASingleCell) {
  const GridLoopProblem problem = ParseCore({"...", ".#.", "..."}, 3, 10);
  const GridLoopReport report = FindShortestLoop(problem);
  ASSERT_EQ(report.outcome, GridLoopOutcome::kFound);
  EXPECT_EQ(report.cost, 4 * 3 + 4 * 10);
  ExpectValidRing(problem, report.ring);
}

TEST(GridLoop, SavesTurnsRatherThanSteps) {
  const GridLoopProblem problem = ParseCore({".....", ".##..", "..##.", "....."}, 1, 10);
  const GridLoopReport report = FindShortestLoop(problem);
  EXPECT_EQ(report.ring.size(), 4u);
  EXPECT_EQ(report.cost, 10 + 40);
}

TEST(GridLoop, FollowsCheapSteps) {
  GridLoopProblem problem = ParseCore({"......", "......", "..#...", "......", "......"}, 100, 10);
  SetEdge(problem, {0, 1}, {0, 5}, 0);
  SetEdge(problem, {0, 5}, {4, 5}, 0);
  SetEdge(problem, {4, 5}, {4, 1}, 0);
  SetEdge(problem, {4, 1}, {0, 1}, 0);
  const GridLoopReport report = FindShortestLoop(problem);
  EXPECT_EQ(report.cost, 40);
  EXPECT_EQ(report.ring.size(), 4u);
}

TEST(GridLoop, IgnoresCheapStepsOfTheWrongDirection) {
  GridLoopProblem problem = ParseCore({"......", "......", "..#...", "......", "......"}, 5, 10);
  SetEdge(problem, {0, 1}, {4, 1}, 0);  // clockwise: the core would be on the right
  SetEdge(problem, {4, 1}, {4, 5}, 0);
  SetEdge(problem, {4, 5}, {0, 5}, 0);
  SetEdge(problem, {0, 5}, {0, 1}, 0);
  EXPECT_EQ(FindShortestLoop(problem).cost, 4 * 5 + 40);
}

TEST(GridLoop, StaysWithinTheMargin) {
  GridLoopProblem problem = ParseCore({"......", "......", "..#...", "......", "......"}, 50, 10);
  for (const auto& [a, b] : {std::pair{GridVertex{0, 0}, GridVertex{0, 6}},
                             {{0, 6}, {5, 6}},
                             {{5, 6}, {5, 0}},
                             {{5, 0}, {0, 0}}}) {
    SetEdge(problem, a, b, 0);
  }
  EXPECT_EQ(FindShortestLoop(problem).cost, 40);
  problem.margin_cells = 1;
  EXPECT_EQ(FindShortestLoop(problem).cost, 200 + 40);
}

TEST(GridLoop, SaysWhyThereIsNone) {
  EXPECT_EQ(FindShortestLoop(ParseCore({"...", "..."}, 1, 1)).outcome, GridLoopOutcome::kEmptyCore);
  EXPECT_EQ(FindShortestLoop(ParseCore({"#..", ".#."}, 1, 1)).outcome,
            GridLoopOutcome::kDisconnectedCore);
  EXPECT_EQ(FindShortestLoop(ParseCore({"...", ".#.", "..."}, kBlockedStep, 1)).outcome,
            GridLoopOutcome::kNoRoute);
  EXPECT_EQ(FindShortestLoop(MakeProblem(0, 0, 1, 1)).outcome, GridLoopOutcome::kEmptyCore);
}

TEST(GridLoop, CoreAtTheBorderIsRoundedAlongTheBorder) {
  const GridLoopProblem problem = ParseCore({"##", "##"}, 1, 1);
  const GridLoopReport report = FindShortestLoop(problem);
  ASSERT_EQ(report.outcome, GridLoopOutcome::kFound);
  EXPECT_EQ(report.cost, 8 + 4);
}

TEST(GridLoop, HoleInTheCoreDoesNotMatter) {
  const GridLoopProblem problem = ParseCore({".....", ".###.", ".#.#.", ".###.", "....."}, 1, 1);
  const GridLoopReport report = FindShortestLoop(problem);
  EXPECT_EQ(report.cost, 12 + 4);
  ExpectValidRing(problem, report.ring);
}

TEST(GridLoop, EqualsBruteForceOnRandomGrids) {
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const GridLoopProblem problem = MakeRandomProblem(6, random);
    ExpectEqualsBruteForce(problem);
    if (HasFailure()) return;
  }
}

TEST(GridLoop, EqualsBruteForceOnFoldedWalls) {
  std::mt19937 random(2);
  int num_folded = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const GridLoopProblem problem = MakeFoldedProblem(10, 40, random);
    ExpectEqualsBruteForce(problem);
    num_folded += FindShortestLoop(problem).num_levels > 1;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_folded, 0);
}

// A free corridor that winds round the core twice and comes back beside itself.
TEST(GridLoop, FollowsADoubleSpiral) {
  GridLoopProblem problem = MakeProblem(16, 16, 1000, 1);
  problem.core[8 * 16 + 7] = 1;
  const std::vector<GridVertex> ring = {{7, 6},   {7, 10}, {11, 10}, {11, 4},  {4, 4},  {4, 13},
                                        {13, 13}, {13, 2}, {12, 2},  {12, 12}, {5, 12}, {5, 5},
                                        {10, 5},  {10, 9}, {9, 9},   {9, 6}};
  for (size_t i = 0; i < ring.size(); ++i)
    SetEdge(problem, ring[i], ring[(i + 1) % ring.size()], 0);
  const GridLoopReport report = FindShortestLoop(problem);
  ASSERT_EQ(report.outcome, GridLoopOutcome::kFound);
  EXPECT_EQ(report.cost, 16);
  EXPECT_EQ(report.ring.size(), ring.size());
  ExpectValidRing(problem, report.ring);
}

}  // namespace
}  // namespace enfilade
