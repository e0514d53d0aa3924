// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace enfilade {

/// The matches of two panoramas without those that a turn about the vertical alone explains,
/// several alike: the landscape behind windows looks the same from many rooms and says nothing
/// about where they lie; through two windows it looks like a room behind a door.
///
/// Takes the unit rays of each match, z up, and returns ascending indices. Cost: O(n²).
[[nodiscard]] std::vector<size_t> WithoutLandscape(std::span<const Eigen::Vector3d> rays_a,
                                                   std::span<const Eigen::Vector3d> rays_b);

}  // namespace enfilade
