// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace enfilade {

/// Normal equations of one window in its step of displacement δd and of log gain δk, from
/// Σ (e + gᵀ δd − t δk)² over pixels with grey level t, gradient g and residual e:
///
///   |  tensor     −coupling | |δd|   | −gradient_residual |
///   | −couplingᵀ      gain  | |δk| = |   gain_residual    |
///
/// A window whose pixels say nothing about the gain has `gain` 0.
struct GainBlock {
  Eigen::Matrix2d tensor = Eigen::Matrix2d::Identity();  ///< Σ g gᵀ, invertible
  Eigen::Vector2d coupling{0, 0};                        ///< Σ t g
  double gain = 0;                                       ///< Σ t²
  Eigen::Vector2d gradient_residual{0, 0};               ///< Σ g e
  double gain_residual = 0;                              ///< Σ t e
};

/// What is left of a block once δd is eliminated: the step that the window would take alone, and
/// the weight of its word.
struct ReducedGain {
  double step = 0;
  double information = 0;  ///< not negative
};
[[nodiscard]] ReducedGain EliminateDisplacement(const GainBlock& block);

/// Σ information · value / Σ information. With the reduced gains of all windows this is the gain of
/// the block-arrow system in which they share one. 0 when nothing has information.
[[nodiscard]] double InformationMean(std::span<const double> values,
                                     std::span<const double> information);

/// As above with Cauchy weights about the result, their scale from the median deviation; sums run
/// in the order of the values.
[[nodiscard]] double RobustInformationMean(std::span<const double> values,
                                           std::span<const double> information);

}  // namespace enfilade
