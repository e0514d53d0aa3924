// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/lamp.h"

#include <algorithm>
#include <limits>

namespace enfilade {

using Eigen::Vector3d;
using Eigen::Vector3f;

std::optional<LampHit> TraceLamps(const Home& home, const Vector3f& origin,
                                  const Vector3f& direction) {
  constexpr double kThickness_m = 0.06;
  LampHit nearest{nullptr, std::numeric_limits<float>::infinity()};
  for (const HomeLamp& lamp : home.lamps) {
    const Vector3d half(lamp.size.x() / 2, lamp.size.y() / 2, 0);
    const Vector3f low = (lamp.center - half).cast<float>();
    const Vector3f high = (lamp.center + half + Vector3d(0, 0, kThickness_m)).cast<float>();
    float enter = 0, leave = nearest.distance_m;
    for (int k = 0; k < 3; ++k) {
      const float a = (low[k] - origin[k]) / direction[k], b = (high[k] - origin[k]) / direction[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > 0 && enter < leave) nearest = {&lamp, enter};
  }
  return nearest.lamp == nullptr ? std::nullopt : std::optional(nearest);
}

}  // namespace enfilade
