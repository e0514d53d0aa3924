// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "src/synthetic/surface.h"

namespace enfilade {

/// Diffuse reflectance of a surface at (u, v): its colour times its pattern, whose mean is about
/// one.
[[nodiscard]] Eigen::Vector3f ReflectanceAt(const Surface& surface, float u, float v);

/// Light that comes from outside along the unit direction (home frame): a bright overcast sky,
/// trees along the horizon, and ground.
[[nodiscard]] Eigen::Vector3f SkyRadiance(const Eigen::Vector3f& direction);

}  // namespace enfilade
