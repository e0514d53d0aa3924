// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace enfilade {

/// x_in_target = scale · R(angle) · x_in_source + translation, in the plan.
struct Similarity2 {
  double scale = 1;
  double angle_rad = 0;
  Eigen::Vector2d translation{0, 0};

  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& p) const;
};

/// One point in two frames, metres.
struct PointPair {
  Eigen::Vector2d source, target;
};

/// Distances beyond this cost no more: what is farther off is an outlier.
inline constexpr double kFitReach_m = 0.5;

/// Σ min(d², kFitReach_m²) over the distances d that the fit leaves in the target frame.
[[nodiscard]] double FitCost(const Similarity2& fit, std::span<const PointPair> pairs);

/// The least-squares fit (Umeyama 1991, in two dimensions); the scale is 1 unless `has_scale`.
/// Requires a pair.
[[nodiscard]] Similarity2 FitLeastSquares(std::span<const PointPair> pairs, bool has_scale);

/// The robust fit: the motion (with scale if `has_scale`) of least FitCost. Hypotheses come from
/// all pairs of points at least 10 cm apart in both frames (every n-th of them above 20 000), and
/// each best one so far is refined by least squares on its inliers (MSAC, Torr and Zisserman 2000,
/// with the local optimisation of Chum, Matas and Kittler 2003). None where no two points are that
/// far apart. Deterministic.
[[nodiscard]] std::optional<Similarity2> FitRobust(std::span<const PointPair> pairs,
                                                   bool has_scale);

}  // namespace enfilade
