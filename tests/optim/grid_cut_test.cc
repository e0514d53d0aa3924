// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/grid_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/optim/boost_grid_cut.h"

namespace enfilade {
namespace {

GridCutProblem MakeProblem(int rows, int cols, int layers = 1) {
  GridCutProblem problem;
  problem.rows = rows;
  problem.cols = cols;
  problem.layers = layers;
  const size_t num_cells = problem.Index(0, 0, layers);
  for (auto* capacity : {&problem.source_capacity, &problem.sink_capacity, &problem.east_capacity,
                         &problem.north_capacity}) {
    capacity->assign(num_cells, 0);
  }
  if (layers != 1) problem.up_capacity.assign(num_cells, 0);
  return problem;
}

// Capacities up to `max_terminal` and `max_pair`; of each kind a share is 0.
GridCutProblem RandomProblem(GridCutProblem problem, int max_terminal, int max_pair, double share,
                             std::mt19937& random) {
  const auto fill = [&](std::vector<int32_t>& capacity, int max) {
    for (int32_t& value : capacity) {
      const bool is_none = std::uniform_real_distribution<>(0, 1)(random) < share;
      value = is_none ? 0 : std::uniform_int_distribution<int32_t>(0, max)(random);
    }
  };
  fill(problem.source_capacity, max_terminal);
  fill(problem.sink_capacity, max_terminal);
  fill(problem.east_capacity, max_pair);
  fill(problem.north_capacity, max_pair);
  fill(problem.up_capacity, max_pair);
  return problem;
}

GridCutProblem RandomProblem(std::mt19937& random, int max_side, int max_layers = 1) {
  const auto pick = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const int max_terminal = 1 << pick(0, 12), max_pair = 1 << pick(0, 12);
  return RandomProblem(MakeProblem(pick(1, max_side), pick(1, max_side), pick(1, max_layers)),
                       max_terminal, max_pair, 0.3 * pick(0, 3), random);
}

// Every labelling in turn: the least cost, and the cells that all cheapest cuts put on the source's
// side.
GridCutReport BruteForce(const GridCutProblem& problem) {
  const size_t num_cells = problem.Index(0, 0, problem.layers);
  GridCutReport best;
  best.cost = std::numeric_limits<int64_t>::max();
  std::vector<uint8_t> is_source(num_cells);
  for (uint32_t bits = 0; bits < (1U << num_cells); ++bits) {
    for (size_t i = 0; i < num_cells; ++i) is_source[i] = (bits >> i) & 1U;
    const int64_t cost = CostOfCut(problem, is_source);
    if (cost > best.cost) continue;
    if (cost < best.cost) best.is_source = is_source;
    best.cost = cost;
    for (size_t i = 0; i < num_cells; ++i) best.is_source[i] &= is_source[i];
  }
  return best;
}

TEST(GridCut, EqualsBruteForceOnTinyGrids) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const GridCutProblem problem = RandomProblem(random, 4);
    const GridCutReport expected = BruteForce(problem), cut = FindGridCut(problem);
    ASSERT_EQ(cut.cost, expected.cost) << trial;
    ASSERT_EQ(cut.is_source, expected.is_source) << trial;
  }
}

TEST(GridCut, EqualsBruteForceOnTinyGridsInSpace) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const GridCutProblem problem = RandomProblem(random, trial % 2 == 0 ? 2 : 3, 4);
    if (problem.source_capacity.size() > 16) continue;
    const GridCutReport expected = BruteForce(problem), cut = FindGridCut(problem);
    ASSERT_EQ(cut.cost, expected.cost) << trial;
    ASSERT_EQ(cut.is_source, expected.is_source) << trial;
  }
}

TEST(GridCut, EqualsBoostOnRandomGridsInSpace) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 100; ++trial) {
    const GridCutProblem problem = RandomProblem(random, 12, 12);
    const GridCutReport cut = FindGridCut(problem);
    ASSERT_EQ(cut.cost, BoostGridCut(problem).Solve()) << trial;
    ASSERT_EQ(cut.cost, CostOfCut(problem, cut.is_source)) << trial;
  }
}

// A wall between two layers costs what a wall between two columns costs.
TEST(GridCut, TurnsLayersIntoColumns) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 50; ++trial) {
    const GridCutProblem problem = RandomProblem(random, 8, 8);
    GridCutProblem turned = MakeProblem(problem.rows, problem.layers, problem.cols);
    const auto index = [&](int row, int col, int layer) { return turned.Index(row, layer, col); };
    for (int layer = 0; layer < problem.layers; ++layer) {
      for (int row = 0; row < problem.rows; ++row) {
        for (int col = 0; col < problem.cols; ++col) {
          const size_t from = problem.Index(row, col, layer), to = index(row, col, layer);
          turned.source_capacity[to] = problem.source_capacity[from];
          turned.sink_capacity[to] = problem.sink_capacity[from];
          turned.north_capacity[to] = problem.north_capacity[from];
          if (problem.layers > 1) turned.east_capacity[to] = problem.up_capacity[from];
          if (problem.cols > 1) turned.up_capacity[to] = problem.east_capacity[from];
        }
      }
    }
    const GridCutReport cut = FindGridCut(problem), other = FindGridCut(turned);
    ASSERT_EQ(cut.cost, other.cost) << trial;
    for (int layer = 0; layer < problem.layers; ++layer) {
      for (int row = 0; row < problem.rows; ++row) {
        for (int col = 0; col < problem.cols; ++col)
          ASSERT_EQ(cut.is_source[problem.Index(row, col, layer)],
                    other.is_source[index(row, col, layer)]);
      }
    }
  }
}

TEST(GridCut, EqualsBoostOnRandomGrids) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 400; ++trial) {
    const GridCutProblem problem = RandomProblem(random, 30);
    const GridCutReport cut = FindGridCut(problem);
    ASSERT_EQ(cut.cost, BoostGridCut(problem).Solve()) << trial;
    ASSERT_EQ(cut.cost, CostOfCut(problem, cut.is_source)) << trial;
  }
}

// Blobs of evidence with a constant price of the border, as floorplans have.
TEST(GridCut, EqualsBoostOnBlobs) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    GridCutProblem problem = MakeProblem(60, 50);
    for (int blob = 0; blob < 25; ++blob) {
      const int row = static_cast<int>(random() % 60), col = static_cast<int>(random() % 50);
      auto& capacity = blob % 2 == 0 ? problem.source_capacity : problem.sink_capacity;
      for (int r = row; r < std::min(row + 12, 60); ++r) {
        for (int c = col; c < std::min(col + 12, 50); ++c)
          capacity[problem.Index(r, c)] += static_cast<int32_t>(random() % 256);
      }
    }
    const int32_t price = 25 << (trial % 6);
    problem.east_capacity.assign(problem.source_capacity.size(), price);
    problem.north_capacity = problem.east_capacity;
    const GridCutReport cut = FindGridCut(problem);
    ASSERT_EQ(cut.cost, BoostGridCut(problem).Solve()) << trial;
    ASSERT_EQ(cut.cost, CostOfCut(problem, cut.is_source)) << trial;
  }
}

// With source and sink exchanged the cost stays, and the smallest source side becomes the smallest
// sink side: the two never overlap.
TEST(GridCut, SourceAndSinkAreAlike) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const GridCutProblem problem = RandomProblem(random, 20);
    GridCutProblem exchanged = problem;
    std::swap(exchanged.source_capacity, exchanged.sink_capacity);
    const GridCutReport cut = FindGridCut(problem), other = FindGridCut(exchanged);
    ASSERT_EQ(cut.cost, other.cost) << trial;
    for (size_t i = 0; i < cut.is_source.size(); ++i)
      ASSERT_FALSE(cut.is_source[i] != 0 && other.is_source[i] != 0) << trial;
  }
}

GridCutProblem Transposed(const GridCutProblem& problem) {
  GridCutProblem result = MakeProblem(problem.cols, problem.rows);
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      const size_t from = problem.Index(row, col), to = result.Index(col, row);
      result.source_capacity[to] = problem.source_capacity[from];
      result.sink_capacity[to] = problem.sink_capacity[from];
      result.north_capacity[to] = problem.east_capacity[from];
      result.east_capacity[to] = problem.north_capacity[from];
    }
  }
  return result;
}

GridCutProblem MirroredInCols(const GridCutProblem& problem) {
  GridCutProblem result = MakeProblem(problem.rows, problem.cols);
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      const size_t from = problem.Index(row, col), to = problem.Index(row, problem.cols - 1 - col);
      result.source_capacity[to] = problem.source_capacity[from];
      result.sink_capacity[to] = problem.sink_capacity[from];
      result.north_capacity[to] = problem.north_capacity[from];
      if (col + 1 < problem.cols) result.east_capacity[to - 1] = problem.east_capacity[from];
    }
  }
  return result;
}

// The smallest source side is unique, so it turns and flips with the grid.
TEST(GridCut, TurnsAndFlipsWithTheGrid) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const GridCutProblem problem = RandomProblem(random, 20);
    const GridCutReport cut = FindGridCut(problem), turned = FindGridCut(Transposed(problem)),
                        flipped = FindGridCut(MirroredInCols(problem));
    ASSERT_EQ(cut.cost, turned.cost);
    ASSERT_EQ(cut.cost, flipped.cost);
    for (int row = 0; row < problem.rows; ++row) {
      for (int col = 0; col < problem.cols; ++col) {
        const uint8_t side = cut.is_source[problem.Index(row, col)];
        ASSERT_EQ(side, turned.is_source[static_cast<size_t>(col * problem.rows + row)]);
        ASSERT_EQ(side, flipped.is_source[problem.Index(row, problem.cols - 1 - col)]);
      }
    }
  }
}

TEST(GridCut, LargestCapacitiesDoNotOverflow) {
  GridCutProblem problem = MakeProblem(3, 3);
  problem.east_capacity.assign(9, kMaxGridCapacity);
  problem.north_capacity = problem.east_capacity;
  for (const size_t i : {0, 1, 2, 3}) problem.source_capacity[i] = kMaxGridCapacity;
  for (const size_t i : {5, 6, 7, 8}) problem.sink_capacity[i] = kMaxGridCapacity;
  const GridCutReport cut = FindGridCut(problem);
  EXPECT_EQ(cut.cost, int64_t{4} * kMaxGridCapacity);
  EXPECT_EQ(cut.cost, BoostGridCut(problem).Solve());
}

TEST(GridCut, WhatNothingPullsIsOnTheSinksSide) {
  const GridCutReport cut = FindGridCut(MakeProblem(4, 5));
  EXPECT_EQ(cut.cost, 0);
  EXPECT_EQ(cut.is_source, std::vector<uint8_t>(20, 0));
  EXPECT_TRUE(FindGridCut(MakeProblem(0, 0)).is_source.empty());
}

TEST(GridCut, RefusesWrongProblems) {
  GridCutProblem problem = MakeProblem(2, 2);
  problem.east_capacity[1] = -1;
  EXPECT_THROW((void)FindGridCut(problem), std::logic_error);
  problem.east_capacity[1] = kMaxGridCapacity;
  problem.north_capacity.pop_back();
  EXPECT_THROW((void)FindGridCut(problem), std::logic_error);
  GridCutProblem in_space = MakeProblem(2, 2, 2);
  in_space.up_capacity.pop_back();
  EXPECT_THROW((void)FindGridCut(in_space), std::logic_error);
}

}  // namespace
}  // namespace enfilade
