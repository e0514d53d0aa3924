// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/cut_costs.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

// One row of cells that are not at the border.
EvidenceGrids RowOf(EvidenceMode mode, const std::vector<float>& wall,
                    const std::vector<float>& free, double cell_m = 0.013) {
  EvidenceGrids evidence;
  evidence.mode = mode;
  evidence.frame = {.cell_m = cell_m, .rows = 3, .cols = static_cast<int>(wall.size()) + 2};
  evidence.wall = evidence.free = ImageF(3, evidence.frame.cols);
  for (size_t i = 0; i < wall.size(); ++i) {
    evidence.wall(1, static_cast<int>(i) + 1) = wall[i];
    evidence.free(1, static_cast<int>(i) + 1) = free[i];
  }
  return evidence;
}

std::vector<int32_t> MiddleRow(const GridCutProblem& problem,
                               const std::vector<int32_t>& capacity) {
  return {capacity.begin() + problem.cols + 1, capacity.begin() + 2 * problem.cols - 1};
}

TEST(CutCosts, CountsFollowThePrototype) {
  const EvidenceGrids evidence =
      RowOf(EvidenceMode::kCounts, {0, 5, 10, 15, 100}, {50, 0, 100, 150, 1000});
  const GridCutProblem problem =
      MakeCutProblem(evidence, {.good_wall_points = 10, .good_free_rays = 100});
  EXPECT_EQ(MiddleRow(problem, problem.sink_capacity), (std::vector<int32_t>{0, 0, 50, 100, 255}));
  EXPECT_EQ(MiddleRow(problem, problem.source_capacity),
            (std::vector<int32_t>{0, 0, 50, 100, 255}));
  EXPECT_EQ(problem.east_capacity[0], 100);
  EXPECT_EQ(problem.north_capacity[0], 100);
}

TEST(CutCosts, CountsAreThoseOfReferenceCells) {
  const PlaneCutOptions options{.good_wall_points = 10, .good_free_rays = 100};
  // Twice as wide: four times the points, twice the rays, half the price of a side.
  const GridCutProblem problem =
      MakeCutProblem(RowOf(EvidenceMode::kCounts, {40, 0}, {0, 200}, 0.026), options);
  EXPECT_EQ(MiddleRow(problem, problem.sink_capacity), (std::vector<int32_t>{50, 0}));
  EXPECT_EQ(MiddleRow(problem, problem.source_capacity), (std::vector<int32_t>{0, 50}));
  EXPECT_EQ(problem.east_capacity[0], 50);
}

TEST(CutCosts, SharesOfTheMeanAreGoodWhereNothingElseIsSaid) {
  const GridCutProblem problem = MakeCutProblem(RowOf(EvidenceMode::kCounts, {0, 2, 6}, {0, 0, 3}),
                                                {.good_wall_share = 1, .good_free_share = 0.5});
  EXPECT_EQ(MiddleRow(problem, problem.sink_capacity), (std::vector<int32_t>{0, 0, 100}));
  EXPECT_EQ(MiddleRow(problem, problem.source_capacity), (std::vector<int32_t>{0, 0, 150}));
}

TEST(CutCosts, LogOddsAreCostsAsTheyAre) {
  const GridCutProblem problem = MakeCutProblem(
      RowOf(EvidenceMode::kLogOdds, {-1, 2, 0.5}, {2.5, -1, 0.5}), {.log_odds_scale = 10});
  EXPECT_EQ(MiddleRow(problem, problem.source_capacity), (std::vector<int32_t>{35, 0, 0}));
  EXPECT_EQ(MiddleRow(problem, problem.sink_capacity), (std::vector<int32_t>{0, 30, 0}));
}

TEST(CutCosts, NothingKeepsTheBorderInside) {
  EvidenceGrids evidence = RowOf(EvidenceMode::kLogOdds, {0, 0}, {0, 0});
  for (float& free : evidence.free.data()) free = 1e9F;
  for (const double lambda : {0.0, 100.0, 100000.0}) {
    const GridCutProblem problem = MakeCutProblem(evidence, {.lambda = lambda});
    const GridCutReport cut = FindGridCut(problem);
    for (int row = 0; row < problem.rows; ++row) {
      for (int col = 0; col < problem.cols; ++col) {
        const bool is_border = row != 1 || col == 0 || col + 1 == problem.cols;
        if (is_border) {
          EXPECT_EQ(cut.is_source[problem.Index(row, col)], 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace enfilade
