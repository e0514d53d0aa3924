// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The cut solver beside the algorithm of the same authors in Boost.Graph, whose graph is built
// beforehand.
#include "enfilade/optim/grid_cut.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "tests/optim/boost_grid_cut.h"

namespace enfilade {
namespace {

GridCutProblem MakeProblem(int rows, int cols, int32_t price) {
  GridCutProblem problem;
  problem.rows = rows;
  problem.cols = cols;
  const size_t num_cells = problem.Index(rows, 0);
  problem.source_capacity.assign(num_cells, 0);
  problem.sink_capacity.assign(num_cells, 0);
  problem.east_capacity.assign(num_cells, price);
  problem.north_capacity.assign(num_cells, price);
  return problem;
}

// Every capacity at random.
GridCutProblem MakeNoise(int rows, int cols) {
  GridCutProblem problem = MakeProblem(rows, cols, 0);
  std::mt19937 random(7);
  for (auto* capacity : {&problem.source_capacity, &problem.sink_capacity, &problem.east_capacity,
                         &problem.north_capacity}) {
    for (int32_t& value : *capacity) value = static_cast<int32_t>(random() % 256);
  }
  return problem;
}

// A home: nine rooms in three rows, free space in two thirds of their cells, walls in two thirds of
// theirs, nothing outside; the price of the border is that of the ladder's middle.
GridCutProblem MakeHome(int rows, int cols) {
  GridCutProblem problem = MakeProblem(rows, cols, 400);
  std::mt19937 random(7);
  const int margin = rows / 10, room_rows = (rows - 2 * margin) / 3,
            room_cols = (cols - 2 * margin) / 3;
  for (int row = margin; row < margin + 3 * room_rows; ++row) {
    for (int col = margin; col < margin + 3 * room_cols; ++col) {
      const int r = (row - margin) % room_rows, c = (col - margin) % room_cols;
      const bool is_wall = std::min({r, c, room_rows - 1 - r, room_cols - 1 - c}) < 3;
      if (random() % 3 == 0) continue;
      auto& capacity = is_wall ? problem.sink_capacity : problem.source_capacity;
      capacity[problem.Index(row, col)] = static_cast<int32_t>(random() % 256);
    }
  }
  return problem;
}

GridCutProblem MakeCase(const benchmark::State& state, bool is_home) {
  const int rows = static_cast<int>(state.range(0)), cols = static_cast<int>(state.range(1));
  return is_home ? MakeHome(rows, cols) : MakeNoise(rows, cols);
}

// The home's storey with walls as high as a room, floor and ceiling below and above all of it.
GridCutProblem MakeHomeInSpace(int rows, int cols, int layers) {
  const GridCutProblem plan = MakeHome(rows, cols);
  GridCutProblem problem;
  problem.rows = rows;
  problem.cols = cols;
  problem.layers = layers;
  const size_t num_cells = problem.Index(0, 0, layers);
  problem.source_capacity.assign(num_cells, 0);
  problem.sink_capacity.assign(num_cells, 0);
  for (auto* side : {&problem.east_capacity, &problem.north_capacity, &problem.up_capacity})
    side->assign(num_cells, 400);
  for (int layer = 2; layer + 2 < layers; ++layer) {
    const bool is_slab = layer < 5 || layer + 5 >= layers;
    for (size_t i = 0; i < plan.source_capacity.size(); ++i) {
      const size_t to = problem.Index(0, 0, layer) + i;
      const int32_t free = plan.source_capacity[i];
      problem.source_capacity[to] = is_slab ? 0 : free;
      problem.sink_capacity[to] = plan.sink_capacity[i] + (is_slab ? free : 0);
    }
  }
  return problem;
}

void BM_FindGridCutInSpace(benchmark::State& state) {
  const GridCutProblem problem =
      MakeHomeInSpace(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                      static_cast<int>(state.range(2)));
  for (auto _ : state) benchmark::DoNotOptimize(FindGridCut(problem));
}

void BM_BoostInSpace(benchmark::State& state) {
  BoostGridCut boost(MakeHomeInSpace(static_cast<int>(state.range(0)),
                                     static_cast<int>(state.range(1)),
                                     static_cast<int>(state.range(2))));
  for (auto _ : state) benchmark::DoNotOptimize(boost.Solve());
}

void BM_FindGridCut(benchmark::State& state, bool is_home) {
  const GridCutProblem problem = MakeCase(state, is_home);
  GridCutReport report;
  for (auto _ : state) {
    report = FindGridCut(problem);
    benchmark::DoNotOptimize(report);
  }
  state.counters["paths"] = static_cast<double>(report.num_augmentations);
}

void BM_BoostBoykovKolmogorov(benchmark::State& state, bool is_home) {
  BoostGridCut boost(MakeCase(state, is_home));
  for (auto _ : state) benchmark::DoNotOptimize(boost.Solve());
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({200, 200})->Args({600, 640})->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(BM_FindGridCut, Home, true)->Apply(Sizes);
BENCHMARK_CAPTURE(BM_BoostBoykovKolmogorov, Home, true)->Apply(Sizes);
BENCHMARK_CAPTURE(BM_FindGridCut, Noise, false)->Apply(Sizes);
BENCHMARK_CAPTURE(BM_BoostBoykovKolmogorov, Noise, false)->Apply(Sizes);
BENCHMARK(BM_FindGridCutInSpace)->Args({100, 100, 30})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_BoostInSpace)->Args({100, 100, 30})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_FindGridCutInSpace)->Args({300, 320, 60})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
