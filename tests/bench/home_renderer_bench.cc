// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/render.h"

namespace enfilade {
namespace {

void BM_BakeLightOfFlat(benchmark::State& state) {
  const Home home = MakeHome({});
  RunContext context(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const HomeRenderer renderer(home, {}, context);
    benchmark::DoNotOptimize(&renderer);
  }
}
BENCHMARK(BM_BakeLightOfFlat)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

void BM_RenderPanorama(benchmark::State& state) {
  const Home home = MakeHome({});
  RunContext context(static_cast<int>(state.range(0)));
  RenderOptions options;
  options.light_cell_m = 0.1;  // the light is not what is measured
  options.gather_rays = 16;
  const HomeRenderer renderer(home, options, context);
  constexpr ImageSize kSize{1024, 512};
  for (auto _ : state) benchmark::DoNotOptimize(renderer.Render(0, kSize, context).rgb.data());
  state.counters["pixels_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kSize.width * kSize.height,
                         benchmark::Counter::kIsRate);
}
BENCHMARK(BM_RenderPanorama)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace enfilade
