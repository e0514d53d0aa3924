// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace enfilade {

/// The largest number of pairs (one of `a`, one of `b`, none twice) at most `max_distance_m` apart:
/// maximum bipartite matching by augmenting paths (Kuhn 1955). Cost O(|a| · pairs within reach).
[[nodiscard]] int CountPointMatches(const std::vector<Eigen::Vector2d>& a,
                                    const std::vector<Eigen::Vector2d>& b, double max_distance_m);

/// 2·hits / (a + b), the harmonic mean of precision and recall; none when a + b is zero.
[[nodiscard]] std::optional<double> F1(int hits, size_t num_a, size_t num_b);

}  // namespace enfilade
