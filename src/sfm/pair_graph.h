// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "enfilade/sfm/types.h"

namespace enfilade {

/// Indices of the connecting pairs that form the spanning forest of largest total strength (ties:
/// lowest index), `strengths` one a pair.
[[nodiscard]] std::vector<size_t> SpanningForest(int num_views, std::span<const PanoPair> pairs,
                                                 std::span<const double> strengths);

/// Calls visit(from, to, pair) for the pairs of a forest, breadth first from the lowest view of
/// each tree, so that `from` was reached before `to`.
void WalkForest(int num_views, std::span<const PanoPair> pairs, std::span<const size_t> forest,
                const std::function<void(int from, int to, const PanoPair& pair)>& visit);

}  // namespace enfilade
