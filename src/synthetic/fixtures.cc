// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixtures.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/structure/wall_samples.h"
#include "enfilade/synthetic/truth.h"
#include "src/synthetic/random.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

std::vector<double> MakeBins(const ProfileNoise& noise) {
  ENFILADE_CHECK(noise.num_bins >= 2 && noise.min_m > 0 && noise.max_m > noise.min_m);
  std::vector<double> bin_m(static_cast<size_t>(noise.num_bins));
  for (int i = 0; i < noise.num_bins; ++i) {
    bin_m[static_cast<size_t>(i)] =
        noise.min_m * std::pow(noise.max_m / noise.min_m, i / (noise.num_bins - 1.0));
  }
  return bin_m;
}

// A Gaussian round the distance over the bins; sums to one. Bins outside the reach keep a little.
void FillProbability(const std::vector<double>& bin_m, double distance_m, double spread_m,
                     float* out) {
  constexpr double kFloor = 1e-4;
  double sum = 0;
  for (size_t i = 0; i < bin_m.size(); ++i) {
    const double z = (bin_m[i] - distance_m) / spread_m;
    const double p = std::exp(-0.5 * z * z) + kFloor;
    out[i] = static_cast<float>(p);
    sum += p;
  }
  for (size_t i = 0; i < bin_m.size(); ++i) out[i] = static_cast<float>(out[i] / sum);
}

PlanSegments SegmentsFor(const Home& home, int storey_idx, const ProfileNoise& noise) {
  PlanSegments segments = MakePlanSegments(home, storey_idx);
  if (!noise.are_doors_walls) return segments;
  Home closed = home;
  for (HomeOpening& opening : closed.openings) {
    if (opening.kind != OpeningKind::kWindow) opening.leaf = DoorLeaf::kClosed;
  }
  segments.walls = MakePlanSegments(closed, storey_idx).walls;
  return segments;
}

WallProfile MakeProfile(const Home& home, int camera_idx, const PlanSegments& segments,
                        const std::vector<double>& bin_m, const ProfileNoise& noise) {
  const HomeCamera& camera = home.cameras[static_cast<size_t>(camera_idx)];
  const HomeRoom& room = home.RoomById(camera.room_id);
  const auto num_columns = static_cast<size_t>(noise.num_columns);
  Random random(PartSeed(noise.seed, static_cast<uint64_t>(camera_idx)));
  WallProfile profile;
  profile.view_idx = camera_idx;
  profile.floor_z = room.floor_z;
  profile.ceiling_z = room.ceiling_z;
  profile.wall_m.resize(num_columns);
  profile.obstacle_m.resize(num_columns);
  profile.confidence.assign(num_columns, 1.0f);
  profile.is_seen.assign(num_columns, 1);
  profile.wall_probability = ImageF(noise.num_columns, noise.num_bins);
  for (int c = 0; c < noise.num_columns; ++c) {
    const double azimuth = AzimuthOfColumn(c, noise.num_columns);
    const Vector2d origin = camera.home_from_cam.translation.head<2>();
    const Vector2d direction(std::cos(azimuth), std::sin(azimuth));
    const std::optional<PlanHit> wall = CastPlanRay(segments.walls, origin, direction);
    const std::optional<PlanHit> obstacle = CastPlanRay(segments.obstacles, origin, direction);
    const double true_m = wall ? wall->distance_m : noise.max_m;
    double wall_m = true_m * (1 + noise.sigma_relative * random.Normal());
    if (random.Chance(noise.outlier_share)) wall_m = random.Uniform(noise.min_m, noise.max_m);
    wall_m = std::clamp(wall_m, noise.min_m, noise.max_m);
    const auto i = static_cast<size_t>(c);
    profile.wall_m[i] = static_cast<float>(wall_m);
    profile.obstacle_m[i] =
        static_cast<float>(obstacle ? std::min(wall_m, obstacle->distance_m) : wall_m);
    FillProbability(bin_m, wall_m, noise.spread_relative * wall_m, profile.wall_probability.row(c));
    if (random.Chance(noise.unseen_share)) {
      profile.is_seen[i] = 0;
      profile.confidence[i] = 0;
    }
  }
  return profile;
}

}  // namespace

Structure FixtureStructure(const Home& home, const ProfileNoise& noise) {
  ENFILADE_CHECK(noise.num_columns > 0 && noise.spread_relative > 0 && !home.rooms.empty());
  Structure structure;
  structure.home_from_world = home.home_from_world;
  structure.heading_rad = YawOf(home.home_from_world.rotation.transpose());
  structure.bin_m = MakeBins(noise);
  std::vector<PlanSegments> segments;
  for (int i = 0; i < home.NumStoreys(); ++i) {
    const auto room = std::find_if(home.rooms.begin(), home.rooms.end(),
                                   [&](const HomeRoom& r) { return r.storey_idx == i; });
    structure.storeys.push_back({room->floor_z, room->ceiling_z, home.baseboard_m});
    segments.push_back(SegmentsFor(home, i, noise));
  }
  for (int i = 0; i < static_cast<int>(home.cameras.size()); ++i) {
    const int storey_idx = home.StoreyOfCamera(i);
    structure.profiles.push_back(
        MakeProfile(home, i, segments[static_cast<size_t>(storey_idx)], structure.bin_m, noise));
  }
  return structure;
}

WallSampleSet FixtureWallSamples(const Home& home, const ProfileNoise& noise, int storey_idx) {
  return MakeWallSamples(FixtureStructure(home, noise), FixtureScene(home), storey_idx);
}

Scene FixtureScene(const Home& home, int width, int height) {
  Scene scene;
  scene.pose_source = PoseSource::kTransforms;
  for (size_t i = 0; i < home.cameras.size(); ++i) {
    View view;
    view.picture = home.cameras[i].picture;
    view.camera = EquirectangularCamera(width, height);
    view.world_from_cam = home.WorldFromCamera(static_cast<int>(i));
    view.storey_idx = home.StoreyOfCamera(static_cast<int>(i));
    scene.views.push_back(view);
  }
  return scene;
}

}  // namespace enfilade
