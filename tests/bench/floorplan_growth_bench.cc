// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// How the floorplan stage grows with the home, from evidence to walls with their σ, without
// pictures: a storey of 10 × 10 m with eight rooms and noisy evidence at 2.5 cm, once and side by
// side. One thread. `exponent` is that of processor time over area since the size before: 1 is
// linear. `peak_mb` is the most memory resident, the evidence included.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "enfilade/geometry/boolean.h"
#include "enfilade/pipeline/memory.h"
#include "tests/floorplan/drawn_evidence.h"

namespace enfilade {
namespace {

constexpr double kTile_m = 10;

// A corridor with doors to rooms on both sides: a bay, a pillar, a stub of wall, a closed closet.
EvidenceGrids DrawTile() {
  MultiPolygon2 free = {
      Box(0.06, 4.3, 9.94, 5.7),  // corridor
      {ParseRing("0.06,0.06 3,0.06 3,1.5 2,1.5 2,1.62 3,1.62 3,4.18 0.06,4.18"), {}},
      Box(3.12, 0.06, 6, 4.18),
      Box(6.12, 0.06, 9.94, 2.1),
      {ParseRing("0.06,5.82 5,5.82 5,9.1 4.2,9.94 1.5,9.94 0.06,9.94"),
       {ParseRing("2.3,7.5 2.3,7.9 2.7,7.9 2.7,7.5")}},
      Box(5.12, 5.82, 7.4, 9.94),
      Box(7.52, 5.82, 9.94, 9.94),
      Box(6.12, 2.22, 9.94, 4.18)};
  for (const auto& [from, to] : {std::pair{1.0, 1.9}, {4.0, 4.8}, {7.0, 7.8}})
    free.push_back(Box(from, 4.1, to, 4.4));
  for (const auto& [from, to] : {std::pair{2.0, 2.8}, {5.6, 6.4}, {8.2, 9.1}})
    free.push_back(Box(from, 5.6, to, 5.9));
  return DrawEvidence(Union(free), {.face_blur_m = 0.03, .noise = 0.7, .core_distance_m = 0.5});
}

// The tile side by side, with 2.5 m of nothing all round.
EvidenceGrids Repeat(const EvidenceGrids& tile, int num_rows, int num_cols) {
  const int size = static_cast<int>(std::lround(kTile_m / tile.frame.cell_m));
  const int margin = size / 4;
  EvidenceGrids grids;
  grids.frame = {
      {0, 0}, tile.frame.cell_m, num_rows * size + 2 * margin, num_cols * size + 2 * margin};
  grids.wall = ImageF(grids.frame.rows, grids.frame.cols);
  grids.free = ImageF(grids.frame.rows, grids.frame.cols);
  grids.core = CoreImage(grids.frame.rows, grids.frame.cols);
  const int first_row = tile.frame.Row(1e-6), first_col = tile.frame.Col(1e-6);
  for (int row = 0; row < num_rows * size; ++row) {
    for (int col = 0; col < num_cols * size; ++col) {
      const int r = first_row + row % size, c = first_col + col % size;
      const int tile_idx = row / size * num_cols + col / size, core = tile.core(r, c);
      grids.wall(margin + row, margin + col) = tile.wall(r, c);
      grids.free(margin + row, margin + col) = tile.free(r, c);
      grids.core(margin + row, margin + col) =
          static_cast<uint16_t>(core == 0 ? 0 : tile_idx * tile.num_cores + core);
    }
  }
  grids.num_cores = num_rows * num_cols * tile.num_cores;
  return grids;
}

void BM_FloorplanGrowth(benchmark::State& state) {
  static double m2_before = 0, seconds_before = 0;
  const int num_rows = static_cast<int>(state.range(0)),
            num_cols = static_cast<int>(state.range(1));
  static const EvidenceGrids tile = DrawTile();
  const std::vector<EvidenceGrids> evidence = {Repeat(tile, num_rows, num_cols)};
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}};
  const FloorplanOptions options;
  size_t num_rooms = 0, num_walls = 0;
  ResetPeakMemory();
  const std::clock_t start = std::clock();
  for (auto _ : state) {
    RunContext context(1);
    Floorplan plan = SolveFloorplan({}, structure, evidence, options, context).plan;
    AssignSigmas({}, structure, evidence, options, plan);
    num_rooms = plan.storeys[0].rooms.size();
    num_walls = plan.storeys[0].walls.size();
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC /
                         static_cast<double>(state.iterations());
  state.counters["cells"] = static_cast<double>(evidence[0].wall.data().size());
  state.counters["rooms"] = static_cast<double>(num_rooms);
  state.counters["walls"] = static_cast<double>(num_walls);
  state.counters["peak_mb"] = PeakMemoryMb();
  const double m2 = num_rows * num_cols * kTile_m * kTile_m;
  if (m2_before > 0)
    state.counters["exponent"] = std::log(seconds / seconds_before) / std::log(m2 / m2_before);
  m2_before = m2;
  seconds_before = seconds;
}
BENCHMARK(BM_FloorplanGrowth)
    ->ArgNames({"tile_rows", "tile_cols"})
    ->Args({1, 1})
    ->Args({2, 5})
    ->Args({10, 10})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
