// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/wall_samples.h"

#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {

WallSampleSet MakeWallSamples(const Structure& structure, const Scene& scene, int storey_idx) {
  ENFILADE_CHECK(structure.profiles.size() == scene.views.size());
  WallSampleSet set{structure.bin_m, {}};
  for (const WallProfile& profile : structure.profiles) {
    const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
    if (view.storey_idx != storey_idx) continue;
    const Eigen::Vector2d origin =
        (structure.home_from_world * view.world_from_cam.translation).head<2>();
    const int num_columns = profile.num_columns();
    for (int c = 0; c < num_columns; ++c) {
      const size_t i = static_cast<size_t>(c);
      if (!profile.is_seen[i]) continue;
      const double azimuth = AzimuthOfColumn(c, num_columns);
      WallSample sample;
      sample.view_idx = profile.view_idx;
      sample.origin = origin;
      sample.direction = {std::cos(azimuth), std::sin(azimuth)};
      sample.spread_rad = 2 * kPi / num_columns;
      sample.wall_m = profile.wall_m[i];
      sample.obstacle_m = profile.obstacle_m[i];
      sample.confidence = profile.confidence[i];
      const float* row = profile.wall_probability.row(c);
      sample.wall_probability.assign(row, row + profile.wall_probability.cols());
      set.samples.push_back(std::move(sample));
    }
  }
  return set;
}

}  // namespace enfilade
