// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace enfilade {

/// Where the axis of the k-th of the ten views of a rig points in its panorama.
inline Eigen::Vector3d RigAxis(int k) {
  if (k == 8) return {0, -1, 0};
  if (k == 9) return {0, 1, 0};
  return {std::sin(k * M_PI / 4), 0, std::cos(k * M_PI / 4)};
}

}  // namespace enfilade
