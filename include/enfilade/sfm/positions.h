// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/sfm/types.h"

namespace enfilade {

/// How much longer one pair's baseline is than another's.
struct LengthRatio {
  int pair_idx = 0, other_idx = 0;  ///< into the pairs
  double log_ratio = 0;             ///< log(length of pair / length of other)
  double sigma = 0.1;
};

/// Ratios of the baselines of connecting pairs that share a panorama and at least three features in
/// it: each pair tells the distance to a shared feature in its own baseline. `level_rays` are the
/// features' rays of every view. The median of the shared features counts.
[[nodiscard]] std::vector<LengthRatio> CollectLengthRatios(
    std::span<const PanoPair> pairs, std::span<const std::vector<Eigen::Vector3d>> level_rays);

/// Gives the accepted pairs lengths that agree best with those that they have (from SetLength) and
/// with the ratios: robust least squares of logarithms, Cauchy's loss. A pair that neither tells
/// anything of keeps the length 0.
void SolveLengths(std::span<const LengthRatio> ratios, std::vector<PanoPair>& pairs);

/// Level positions of the views in camera heights, the first view of each component at the origin,
/// from the pairs' directions (turned by `yaws`, level frame to world) and lengths: robust least
/// squares, iteratively reweighted with Cauchy's loss that narrows, from the spanning tree of the
/// surest pairs. Pairs of unknown length tell their direction alone. Pairs whose direction misses
/// the result by more than 10° become kAgainstPositions, and what is left is solved anew. Cost: one
/// sparse solve an iteration.
[[nodiscard]] std::vector<Eigen::Vector2d> SolvePositions(std::span<const double> yaws,
                                                          std::vector<PanoPair>& pairs);

}  // namespace enfilade
