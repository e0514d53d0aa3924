// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/rooms.h"

#include <algorithm>
#include <utility>

#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kSeenShare = 0.7;

/// The smallest value with at least half of the weight at or below it.
double WeightedMedian(std::vector<std::pair<double, double>> values, double fallback) {
  std::sort(values.begin(), values.end());
  double total = 0, sum = 0;
  for (const auto& [value, weight] : values) total += weight;
  if (total <= 0) return fallback;
  for (const auto& [value, weight] : values) {
    sum += weight;
    if (sum >= 0.5 * total) return value;
  }
  return values.back().first;
}

}  // namespace

WallSeen SeenOf(double seen_share) {
  if (seen_share >= kSeenShare) return WallSeen::kSeen;
  return seen_share >= kPartlySeenShare ? WallSeen::kPartly : WallSeen::kInferred;
}

std::vector<HeightSample> HeightSamples(const Scene& scene, const Structure& structure,
                                        int storey_idx) {
  std::vector<HeightSample> samples;
  for (const WallProfile& profile : structure.profiles) {
    const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
    if (view.storey_idx != storey_idx) continue;
    const Eigen::Vector3d position = structure.home_from_world * view.world_from_cam.translation;
    samples.push_back(
        {position.head<2>(), profile.floor_z, profile.ceiling_z, profile.ceiling_weight});
  }
  return samples;
}

std::vector<PlanCamera> PlanCameras(const Scene& scene) {
  std::vector<PlanCamera> cameras;
  for (const View& view : scene.views) {
    cameras.push_back({view.picture, view.sha256, view.storey_idx, view.component_idx,
                       view.is_pose_inferred, view.world_from_cam});
  }
  return cameras;
}

Room MakeRoom(const Polygon2& polygon, const StoreyStructure& heights,
              const std::vector<HeightSample>& samples) {
  Room room;
  room.polygon = polygon;
  std::vector<std::pair<double, double>> floors, ceilings;
  for (const HeightSample& sample : samples) {
    if (!Contains(polygon, sample.position)) continue;
    floors.emplace_back(sample.floor_z, 1.0);
    ceilings.emplace_back(sample.ceiling_z, sample.ceiling_weight);
  }
  room.floor_z = WeightedMedian(floors, heights.floor_z);
  room.ceiling_z = WeightedMedian(ceilings, heights.ceiling_z);
  return room;
}

size_t AppendWalls(const Room& room, double thickness_m, Storey& storey) {
  const size_t first = storey.walls.size();
  for (const Ring2& ring : RingsOf(room.polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      Wall& wall = storey.walls.emplace_back();
      wall.id = static_cast<int>(storey.walls.size()) - 1;
      wall.a = ring[i];
      wall.b = ring[(i + 1) % ring.size()];
      wall.room_id = room.id;
      wall.thickness_m = thickness_m;
    }
  }
  return first;
}

void AddRoom(const LoopField& field, const Polygon2& polygon, const StoreyStructure& heights,
             const std::vector<HeightSample>& samples, const FloorplanOptions& options,
             Storey& storey) {
  Room room = MakeRoom(polygon, heights, samples);
  room.id = static_cast<int>(storey.rooms.size());
  for (size_t i = AppendWalls(room, options.wall_thickness_m, storey); i < storey.walls.size();
       ++i) {
    Wall& wall = storey.walls[i];
    wall.seen = SeenOf(MeasureWallBand(field, wall.a, wall.b, options.slide_m).seen_share);
  }
  storey.rooms.push_back(std::move(room));
}

}  // namespace enfilade
