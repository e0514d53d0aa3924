// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// How registration grows with the number of panoramas once pairs are selected: rooms in a row with
// four cameras each, everything from features to refined poses. One thread. `per_panorama_ms` is
// the processor time that one panorama costs, `growth` that figure beside the one of half as many
// panoramas: 1 is linear, 2 is quadratic.
#include "enfilade/sfm/register.h"

#include <benchmark/benchmark.h>

#include <ctime>
#include <map>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

constexpr int kCamerasPerRoom = 4;

RegistrationScene MakeBuilding(int num_cameras) {
  MadeSceneOptions options;
  options.noise_rad = DegToRad(0.05);
  options.gravity_noise_rad = DegToRad(0.1);
  options.false_share = 0.1;
  // As in homes, most features of a picture are of no use.
  options.num_points_per_room = 200;
  options.lone_share = 4;
  return MakeRowOfRooms(options, num_cameras / kCamerasPerRoom, kCamerasPerRoom, true);
}

void BM_RegistrationGrowth(benchmark::State& state) {
  static std::map<int, double> per_panorama_ms;
  const int num_cameras = static_cast<int>(state.range(0));
  const RegistrationScene scene = MakeBuilding(num_cameras);
  RegisterOptions options;
  options.selection.all_pairs_up_to = 2;
  options.selection.num_coarse_features = 150;  // a fifth of a panorama's
  Registration result;
  const std::clock_t start = std::clock();
  for (auto _ : state) {
    RunContext context(1);
    result = RegisterFeatures(scene.features, scene.gravity, options, context);
  }
  const double spent_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double ms = spent_ms / static_cast<double>(state.iterations()) / num_cameras;
  per_panorama_ms[num_cameras] = ms;
  state.counters["pairs"] = static_cast<double>(result.pairs.size());
  state.counters["points"] = static_cast<double>(result.tracks.size());
  state.counters["per_panorama_ms"] = ms;
  const auto half = per_panorama_ms.find(num_cameras / 2);
  if (half != per_panorama_ms.end()) state.counters["growth"] = ms / half->second;
}
BENCHMARK(BM_RegistrationGrowth)
    ->ArgName("panoramas")
    ->RangeMultiplier(2)
    ->Range(32, 512)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
