// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The loops for every number of turns up to 64: one sweep, all seams, and through twelve anchors.
#include "enfilade/optim/turn_loops.h"

#include <benchmark/benchmark.h>

#include <vector>

#include "src/optim/turn_sweep.h"
#include "tests/bench/grid_homes.h"

namespace enfilade {
namespace {

constexpr int kMaxTurns = 64;

int RowsOf(const benchmark::State& state) { return static_cast<int>(state.range(0)) * 15 / 16; }
int ColsOf(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

// 64 layers from all seams to all states of the grid.
void BM_TurnSweep(benchmark::State& state) {
  const LoopBox box(MakeNoise(RowsOf(state), ColsOf(state)));
  TurnSweep sweep(box, {1, box.rows() - 2, 1, box.cols() - 2, 0, 0}, kMaxTurns);
  const std::vector<int32_t> costs(static_cast<size_t>(box.num_seams()), 0);
  for (auto _ : state) {
    sweep.StartAtSeams(0, costs);
    for (int k = 0; k < kMaxTurns; ++k) sweep.AddTurn();
    benchmark::DoNotOptimize(sweep.CostOf(box.seam_top(), 1, kNorth));
  }
  state.SetItemsProcessed(sweep.num_relaxed());
}
BENCHMARK(BM_TurnSweep)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

void RunLoopsByTurns(benchmark::State& state, const TurnLoopProblem& problem) {
  TurnLoopReport report;
  for (auto _ : state) {
    report = FindLoopsByTurns(problem);
    benchmark::DoNotOptimize(report);
  }
  state.SetItemsProcessed(state.iterations() * report.num_relaxed);
  state.counters["loops"] = static_cast<double>(report.loops.size());
  state.counters["relaxed"] = static_cast<double>(report.num_relaxed);
}

void BM_FindLoopsByTurnsInNoise(benchmark::State& state) {
  TurnLoopProblem problem;
  problem.grid = MakeNoise(RowsOf(state), ColsOf(state));
  RunLoopsByTurns(state, problem);
}
BENCHMARK(BM_FindLoopsByTurnsInNoise)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

void BM_FindLoopsByTurnsAlongWalls(benchmark::State& state) {
  const std::vector<GridVertex> outline = MakeOutline(RowsOf(state), ColsOf(state), 3);
  TurnLoopProblem problem;
  problem.grid = MakeWalls(RowsOf(state), ColsOf(state), outline);
  RunLoopsByTurns(state, problem);
}
BENCHMARK(BM_FindLoopsByTurnsAlongWalls)
    ->Arg(320)
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond);

// Anchors in the middle of every third or fourth wall.
void BM_FindLoopsByTurnsWithAnchors(benchmark::State& state) {
  constexpr size_t kNumAnchors = 12;
  const std::vector<GridVertex> outline = MakeOutline(RowsOf(state), ColsOf(state), 3);
  TurnLoopProblem problem;
  problem.grid = MakeWalls(RowsOf(state), ColsOf(state), outline);
  size_t next_anchor = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const GridVertex a = outline[i], b = outline[(i + 1) % outline.size()];
    problem.guide.push_back(a);
    if (i * kNumAnchors < next_anchor * outline.size()) continue;
    problem.anchors.push_back({static_cast<int>(problem.guide.size()), std::nullopt});
    problem.guide.push_back({(a.row + b.row) / 2, (a.col + b.col) / 2});
    ++next_anchor;
  }
  state.counters["anchors"] = static_cast<double>(problem.anchors.size());
  RunLoopsByTurns(state, problem);
}
BENCHMARK(BM_FindLoopsByTurnsWithAnchors)
    ->Arg(320)
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
