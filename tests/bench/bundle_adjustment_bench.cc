// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// Bundle adjustment of rooms in a row with four cameras each, from poses that are some centimetres
// and half a degree off, as registration hands it over; and the relative pose of one pair. One
// thread. The whole adjustment beside its first iterations alone: their difference tells what an
// iteration costs.
#include "enfilade/sfm/bundle_adjustment.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/two_view.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

constexpr int kCamerasPerRoom = 4;

RegistrationScene MakeRow(int num_cameras) {
  MadeSceneOptions options;
  options.num_points_per_room = 1000;
  options.noise_rad = DegToRad(0.05);
  return MakeRowOfRooms(options, num_cameras / kCamerasPerRoom, kCamerasPerRoom, true);
}

void BM_AdjustBundle(benchmark::State& state) {
  const RegistrationScene scene = MakeRow(static_cast<int>(state.range(0)));
  const BundleOptions options{.max_iterations = static_cast<int>(state.range(1))};
  std::vector<Rigid3> start = scene.world_from_cam;
  std::vector<Track> start_tracks = TrueTracks(scene);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&]() {
    return Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  };
  for (Rigid3& pose : start) {
    pose.translation += 0.02 * any();
    pose.rotation = RotationZ(DegToRad(0.5) * uniform(random)) * pose.rotation;
  }
  double num_rays = 0;
  for (Track& track : start_tracks) {
    track.position += 0.02 * any();
    num_rays += static_cast<double>(track.observations.size());
  }
  for (auto _ : state) {
    std::vector<Rigid3> poses = start;
    std::vector<Track> tracks = start_tracks;
    LevelPlanes planes{0, {1.7}};
    benchmark::DoNotOptimize(
        AdjustBundle(scene.features, scene.gravity, options, poses, tracks, planes));
  }
  state.counters["points"] = static_cast<double>(start_tracks.size());
  state.counters["rays"] = num_rays;
}
BENCHMARK(BM_AdjustBundle)
    ->ArgNames({"cameras", "max_iterations"})
    ->ArgsProduct({{8, 32, 128}, {1, 5, 50}})
    ->Unit(benchmark::kMillisecond);

// One false match beside every true one.
void BM_EstimatePair(benchmark::State& state) {
  MadeSceneOptions options;
  options.num_points_per_room = 1000;
  options.noise_rad = DegToRad(0.05);
  const RegistrationScene scene =
      MakeRegistrationScene(options, SpreadCameras(0.2, 3, options.depth, 2, 1));
  const std::vector<Eigen::Vector3d> rays_a = LevelRaysOf(scene, 0), rays_b = LevelRaysOf(scene, 1);
  std::vector<FeatureMatch> matches = TrueMatches(scene, 0, 1);
  const size_t count = static_cast<size_t>(state.range(0));
  matches.resize(std::min(matches.size(), count / 2));
  std::mt19937 random(1);
  while (matches.size() < count) {
    matches.push_back({static_cast<int>(random() % rays_a.size()),
                       static_cast<int>(random() % rays_b.size()), 0.5F});
  }
  for (auto _ : state) benchmark::DoNotOptimize(EstimatePair(rays_a, rays_b, matches, {}));
}
BENCHMARK(BM_EstimatePair)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
