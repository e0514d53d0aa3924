// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "enfilade/synthetic/home.h"

namespace enfilade {

struct LampHit {
  const HomeLamp* lamp = nullptr;
  float distance_m = 0;
};

/// The nearest lamp's shade (a flat box) along the ray.
[[nodiscard]] std::optional<LampHit> TraceLamps(const Home& home, const Eigen::Vector3f& origin,
                                                const Eigen::Vector3f& direction);

}  // namespace enfilade
