// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/sfm/descriptor_matcher.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/wall_view.h"

namespace enfilade {

/// Quarter turns that two panoramas of a room with square walls may have to each other.
inline constexpr int kNumTurns = 4;

/// Camera frame from the frame of the wall views: z up, +x along the heading.
[[nodiscard]] Eigen::Matrix3d CamFromWalls(const Gravity& gravity);

/// Yaw of b in a's level frame if level view k of a looks the same way as view k + `turn` of b
/// does; none unless both headings are known and all features with descriptors know their views.
[[nodiscard]] std::optional<double> YawOfTurn(const PanoFeatures& a, const Gravity& gravity_a,
                                              const PanoFeatures& b, const Gravity& gravity_b,
                                              int turn);

/// The quarter turn between 0 and 3 for which YawOfTurn is nearest to a yaw.
[[nodiscard]] int TurnOfYaw(const Gravity& gravity_a, const Gravity& gravity_b, double yaw_rad);

/// MatchDescriptors within the views that look the same way, each by itself: what looks alike on
/// other walls does not make a match ambiguous. Floors and ceilings of b are turned as a sees them.
/// Ascending in a_idx.
[[nodiscard]] std::vector<FeatureMatch> MatchWalls(const PanoFeatures& a, const PanoFeatures& b,
                                                   int turn, const DescriptorMatchOptions& options);

/// MatchWalls for the turn that is nearest to the yaw of b in a's level frame; where walls are not
/// known, MatchDescriptors of all with all.
[[nodiscard]] std::vector<FeatureMatch> MatchAtYaw(const PanoFeatures& a, const Gravity& gravity_a,
                                                   const PanoFeatures& b, const Gravity& gravity_b,
                                                   double yaw_rad,
                                                   const DescriptorMatchOptions& options);

/// Logarithms of the sizes that a panorama's features with descriptors would have at unit distance
/// (PairHints): a feature that is seen head-on gets smaller with the distance from its wall.
[[nodiscard]] std::vector<double> LogSizes(const PanoFeatures& features,
                                           std::span<const Eigen::Vector3d> level_rays,
                                           const Gravity& gravity);

}  // namespace enfilade
