// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <limits>
#include <memory>
#include <vector>

#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/render.h"
#include "enfilade/synthetic/write_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

// A ray as the renderer asked for it.
struct AskedRay {
  RTCRay ray;
  bool is_shadow = false;
};

// While `recorded` is set, the rays that the renderer casts are kept there, in order.
std::vector<AskedRay>* recorded = nullptr;
std::atomic<RTCScene> last_scene = nullptr;

void Record(RTCScene scene, const RTCRay& ray, bool is_shadow) {
  last_scene.store(scene, std::memory_order_relaxed);
  if (recorded != nullptr) recorded->push_back({ray, is_shadow});
}

void RecordPacket(const int* valid, RTCScene scene, RTCRay4& rays, bool is_shadow) {
  last_scene.store(scene, std::memory_order_relaxed);
  for (unsigned i = 0; recorded != nullptr && i < 4; ++i) {
    if (valid[i] == 0) continue;
    Record(scene, rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&rays), 4, i), is_shadow);
  }
}

}  // namespace
}  // namespace enfilade

// The linker sends the renderer's calls of Embree here (ld --wrap).
extern "C" {
void __real_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* hit);
void __real_rtcIntersect4(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          RTCRayHit4* hits);
void __real_rtcOccluded4(const int* valid, RTCScene scene, RTCIntersectContext* context,
                         RTCRay4* rays);
void __real_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray);

void __wrap_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* hit) {
  enfilade::Record(scene, hit->ray, false);
  __real_rtcIntersect1(scene, context, hit);
}

void __wrap_rtcIntersect4(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          RTCRayHit4* hits) {
  enfilade::RecordPacket(valid, scene, hits->ray, false);
  __real_rtcIntersect4(valid, scene, context, hits);
}

void __wrap_rtcOccluded4(const int* valid, RTCScene scene, RTCIntersectContext* context,
                         RTCRay4* rays) {
  enfilade::RecordPacket(valid, scene, *rays, true);
  __real_rtcOccluded4(valid, scene, context, rays);
}

void __wrap_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  enfilade::Record(scene, *ray, true);
  __real_rtcOccluded1(scene, context, ray);
}
}

namespace enfilade {
namespace {

// Processor time: other programs' share of the machine does not count.
template <typename F>
double SecondsOf(const F& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Embree alone: casts the rays one after the other and does nothing with the answers.
void CastBare(RTCScene scene, const std::vector<AskedRay>& rays) {
  for (const AskedRay& asked : rays) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    query.ray = asked.ray;
    if (asked.is_shadow) {
      __real_rtcOccluded1(scene, &context, &query.ray);
    } else {
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      __real_rtcIntersect1(scene, &context, &query);
    }
    benchmark::DoNotOptimize(query.ray.tfar);
  }
}

// Runs `work` on one thread and then, on the same scene, the bare loop over the very rays that it
// casts, several times in turn. `share` is the renderer's rate of rays by that of the bare loop,
// each in its fastest run: what other programs take away comes and goes. The last scene must
// outlive the work.
template <typename F>
void CompareWithBareLoop(benchmark::State& state, const F& work) {
  std::vector<AskedRay> rays;
  recorded = &rays;
  work();
  recorded = nullptr;
  double work_s = std::numeric_limits<double>::infinity(), bare_s = work_s;
  for (auto _ : state) {
    work_s = std::min(work_s, SecondsOf(work));
    bare_s = std::min(bare_s, SecondsOf([&] { CastBare(last_scene, rays); }));
  }
  state.counters["rays_per_s"] = static_cast<double>(rays.size()) / work_s;
  state.counters["bare_rays_per_s"] = static_cast<double>(rays.size()) / bare_s;
  state.counters["share"] = bare_s / work_s;
}

RenderOptions CoarseLight() {
  RenderOptions options;
  options.light_cell_m = 0.1;
  options.gather_rays = 16;
  return options;
}

void BM_RaysOfLight(benchmark::State& state) {
  const Home home = MakeHome({});
  RunContext context(1);
  RenderOptions options;
  options.light_cell_m = 0.12;
  std::unique_ptr<HomeRenderer> renderer;
  CompareWithBareLoop(state,
                      [&] { renderer = std::make_unique<HomeRenderer>(home, options, context); });
}
BENCHMARK(BM_RaysOfLight)->Unit(benchmark::kSecond)->Iterations(5);

void BM_RaysOfPanorama(benchmark::State& state) {
  const Home home = MakeHome({});
  RunContext context(1);
  const HomeRenderer renderer(home, CoarseLight(), context);
  CompareWithBareLoop(state, [&] {
    benchmark::DoNotOptimize(renderer.Render(0, {512, 256}, context).rgb.data());
  });
}
BENCHMARK(BM_RaysOfPanorama)->Unit(benchmark::kSecond)->Iterations(15);

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
  const HomeRenderer renderer(home, CoarseLight(), context);  // the light is not what is measured
  constexpr ImageSize kSize{1024, 512};
  for (auto _ : state) benchmark::DoNotOptimize(renderer.Render(0, kSize, context).rgb.data());
  state.counters["pixels_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kSize.width * kSize.height,
                         benchmark::Counter::kIsRate);
}
BENCHMARK(BM_RenderPanorama)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->UseRealTime();

// A whole tour as `enfilade synth --preset tour` makes it; two minutes on two cores are allowed.
void BM_WriteTour(benchmark::State& state) {
  HomeOptions home_options;
  home_options.preset = HomePreset::kTour;
  const Home home = MakeHome(home_options);
  WriteHomeOptions options;
  options.width = UsualWidth(home_options.preset);
  RunContext context(2);
  const TempFolder folder;
  for (auto _ : state) WriteHome(folder.path(), home, options, context);
  state.counters["panoramas"] = static_cast<double>(home.cameras.size());
}
BENCHMARK(BM_WriteTour)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);

}  // namespace
}  // namespace enfilade
