// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/evidence/plan_samples.h"

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {

PlanToSample PlanFromText(std::string_view ring, std::vector<Eigen::Vector2d> cameras) {
  PlanToSample plan;
  plan.rings = {ParseRing(ring)};
  plan.cameras = std::move(cameras);
  return plan;
}

std::vector<double> LogBins(int num_bins) {
  std::vector<double> bins;
  for (int i = 0; i < num_bins; ++i) bins.push_back(0.2 * std::pow(15 / 0.2, i / (num_bins - 1.0)));
  return bins;
}

double NearestWall(const std::vector<Ring2>& rings, const Eigen::Vector2d& origin,
                   const Eigen::Vector2d& direction) {
  double nearest = 15;
  for (const Ring2& ring : rings) nearest = std::min(nearest, RayDistance(ring, origin, direction));
  return nearest;
}

WallSampleSet SamplesOf(const PlanToSample& plan) {
  WallSampleSet set;
  set.bin_m = LogBins(plan.num_bins);
  const auto cdf = [&](double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * plan.sigma_m)); };
  for (size_t v = 0; v < plan.cameras.size(); ++v) {
    for (int c = 0; c < plan.num_columns; ++c) {
      const double azimuth = 2 * kPi * (c + 0.5) / plan.num_columns - kPi;
      WallSample sample;
      sample.view_idx = static_cast<int>(v);
      sample.origin = plan.cameras[v];
      sample.direction = {std::cos(azimuth), std::sin(azimuth)};
      sample.spread_rad = 2 * kPi / plan.num_columns;
      sample.wall_m = plan.distance ? plan.distance(sample.view_idx, sample.direction)
                                    : NearestWall(plan.rings, sample.origin, sample.direction);
      sample.obstacle_m = sample.wall_m;
      sample.confidence = 1;
      double below = 0;
      for (size_t i = 0; i < set.bin_m.size(); ++i) {
        const bool is_last = i + 1 == set.bin_m.size();
        const double edge = is_last ? 0 : 0.5 * (set.bin_m[i] + set.bin_m[i + 1]);
        const double above = is_last ? 1 : cdf(edge - sample.wall_m);
        sample.wall_probability.push_back(static_cast<float>(above - below));
        below = above;
      }
      set.samples.push_back(std::move(sample));
    }
  }
  return set;
}

}  // namespace enfilade
