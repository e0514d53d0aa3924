// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/lamp.h"

#include <algorithm>

namespace enfilade {

using Eigen::Vector3d;
using Eigen::Vector3f;

std::vector<LampShade> MakeLampShades(const Home& home, int storey_idx) {
  constexpr double kThickness_m = 0.06;
  std::vector<LampShade> shades;
  for (const HomeLamp& lamp : home.lamps) {
    if (!home.IsOnStorey(lamp.room_id, storey_idx)) continue;
    const Vector3d half(lamp.size.x() / 2, lamp.size.y() / 2, 0);
    shades.push_back({(lamp.center - half).cast<float>(),
                      (lamp.center + half + Vector3d(0, 0, kThickness_m)).cast<float>(), &lamp});
  }
  return shades;
}

std::optional<LampHit> TraceLamps(std::span<const LampShade> shades, const Vector3f& origin,
                                  const Vector3f& direction, float max_m) {
  LampHit nearest{nullptr, max_m};
  for (const LampShade& shade : shades) {
    // Most rays look down from below all lamps.
    if (direction.z() <= 0 && origin.z() < shade.low.z()) continue;
    float enter = 0, leave = nearest.distance_m;
    for (int k = 0; k < 3; ++k) {
      const float a = (shade.low[k] - origin[k]) / direction[k],
                  b = (shade.high[k] - origin[k]) / direction[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > 0 && enter < leave) nearest = {shade.lamp, enter};
  }
  return nearest.lamp == nullptr ? std::nullopt : std::optional(nearest);
}

}  // namespace enfilade
