// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/synthetic/home.h"

namespace enfilade {

/// A lamp's shade: a flat box.
struct LampShade {
  Eigen::Vector3f low, high;
  const HomeLamp* lamp = nullptr;
};

/// One for every lamp of the storey. `home` must outlive them.
[[nodiscard]] std::vector<LampShade> MakeLampShades(const Home& home, int storey_idx);

struct LampHit {
  const HomeLamp* lamp = nullptr;
  float distance_m = 0;
};

/// The nearest shade along the ray that is nearer than `max_m`.
[[nodiscard]] std::optional<LampHit> TraceLamps(std::span<const LampShade> shades,
                                                const Eigen::Vector3f& origin,
                                                const Eigen::Vector3f& direction, float max_m);

}  // namespace enfilade
