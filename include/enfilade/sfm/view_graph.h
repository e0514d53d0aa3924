// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/sfm/types.h"

namespace enfilade {

/// True for pairs that tie their two panoramas together.
[[nodiscard]] bool IsConnecting(const PanoPair& pair);

/// The connected components of `num_views` panoramas under the connecting pairs: for every view the
/// index of its component, components numbered from the largest (ties: lowest view) on.
[[nodiscard]] std::vector<int> FindComponents(int num_views, std::span<const PanoPair> pairs);

/// Robust averaging of the pairs' yaws. Returns world yaws, level frame to world, one a view; the
/// first view of each component has 0.
///
/// Starts from the spanning tree of the strongest pairs, a pair's strength being its inliers,
/// raised by triplets that close within 3° and lowered by those that do not (Zach, Klopschitz and
/// Pollefeys, CVPR 2010); goes on with iteratively reweighted least squares over all pairs
/// (Chatterjee and Govindu, ICCV 2013). Pairs that then miss the averages by more than 4° become
/// kAgainstTriplets, and what is left is averaged anew, so the graph may fall apart. Cost:
/// O(views³) time for dense graphs.
[[nodiscard]] std::vector<double> AverageYaws(int num_views, std::vector<PanoPair>& pairs);

}  // namespace enfilade
