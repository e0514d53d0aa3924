// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The Viterbi over planes on scores as a panorama gives them: one clear wall in noise. Counted in
// columns × states; a state is a plane, that is one family and one offset.
#include "enfilade/structure/plane_viterbi.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

// A room of 4.4 × 3.2 m round the camera.
ColumnScores MakeScores(int num_columns, int num_families, const DistanceBins& bins) {
  std::mt19937 random(3);
  ColumnScores scores;
  for (int f = 0; f < num_families; ++f) {
    ImageF picture(num_columns, bins.count);
    for (float& value : picture.data()) value = 0.3F * static_cast<float>(random() % 1000) / 1000;
    scores.family[static_cast<size_t>(f)] = std::move(picture);
  }
  for (int c = 0; c < num_columns; ++c) {
    const double azimuth = AzimuthOfColumn(c, num_columns);
    const double x_wall = 2.2 / std::abs(std::cos(azimuth)),
                 y_wall = 1.6 / std::abs(std::sin(azimuth));
    const size_t family = x_wall < y_wall ? 1 : 0;
    scores.family[family](c, static_cast<int>(std::lround(bins.Bin(std::min(x_wall, y_wall))))) = 1;
  }
  return scores;
}

void FindPath(benchmark::State& state, int num_families, bool with_likelihood) {
  const int num_columns = static_cast<int>(state.range(0));
  const DistanceBins bins;
  const ColumnScores scores = MakeScores(num_columns, num_families, bins);
  for (auto _ : state) {
    benchmark::DoNotOptimize(FindWallPath(scores, bins, {}, with_likelihood));
  }
  const double num_cells = static_cast<double>(num_columns) * num_families * bins.count;
  state.counters["columns*states/s"] =
      benchmark::Counter(num_cells, benchmark::Counter::kIsIterationInvariantRate);
}

void BM_AxisPlanes(benchmark::State& state) { FindPath(state, 2, false); }
void BM_AllPlanes(benchmark::State& state) { FindPath(state, kNumFamilies, false); }
void BM_AllPlanesWithLikelihood(benchmark::State& state) { FindPath(state, kNumFamilies, true); }

// As the search for heights calls it, and as the wall profiles are found.
BENCHMARK(BM_AxisPlanes)->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AllPlanes)->Arg(256)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AllPlanesWithLikelihood)->Arg(1024)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
