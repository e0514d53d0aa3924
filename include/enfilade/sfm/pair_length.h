// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/sfm/types.h"

namespace enfilade {

/// What the points of a pair say of its baseline's length: a feature on the floor lies one camera
/// height below the camera, one on the ceiling `ceiling` camera heights above it, and nothing lies
/// beyond either. All other points of a room lie between, so that the right length is the largest
/// at which hardly any point goes beyond while many lie on floor or ceiling.
struct LengthVote {
  double log_length = 0;  ///< at which the point lies on its plane, camera heights
  double sigma = 0;       ///< of log_length
  bool is_above = false;  ///< a vote through the ceiling; log_length then lacks log(ceiling)
  double weight = 1;      ///< matches of one spot count as one
};

/// The votes of the agreeing matches of an accepted pair. Points near the horizon or with less than
/// a degree of parallax have none.
[[nodiscard]] std::vector<LengthVote> CollectLengthVotes(
    const PanoPair& pair, std::span<const Eigen::Vector3d> level_rays_a,
    std::span<const Eigen::Vector3d> level_rays_b);

/// Height of the ceiling above the cameras in camera heights that lets the votes of all pairs agree
/// best, for homes whose rooms are about equally high; 0 when no pair has votes from above.
[[nodiscard]] double FindCeiling(std::span<const std::vector<LengthVote>> votes_of_pairs);

/// Fills length and length_sigma of a pair from its votes; `ceiling` 0 leaves votes from above out.
/// The length stays 0 when fewer than three points lie on a plane.
void SetLength(std::span<const LengthVote> votes, double ceiling, PanoPair& pair);

}  // namespace enfilade
