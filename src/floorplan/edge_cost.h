// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "src/floorplan/loop_field.h"

namespace enfilade {

/// What a wall pays for, without its corners.
struct EdgeTerms {
  double unseen_m = 0;         ///< length where no wall is seen
  double free_outside_m2 = 0;  ///< free space left outside, as far as one can look
  double solid_inside_m2 = 0;  ///< solid wall taken in
};

/// The terms of the segment a → b, which has the room on its left.
[[nodiscard]] EdgeTerms MeasureEdge(const LoopField& field, const FloorplanOptions& options,
                                    const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The terms with their weights, in metres of unseen wall.
[[nodiscard]] double CostOf(const EdgeTerms& terms, const FloorplanOptions& options);

/// What the loop's cost is for walls of any direction: the cost in metres of unseen wall of the
/// segment a → b with the room on its left, without its corners. Along the axes, on cell borders,
/// it is the sum of LoopField::step_cost.
[[nodiscard]] double EdgeCost(const LoopField& field, const FloorplanOptions& options,
                              const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// How much of the segment's length is seen as a wall face, 0–1: mean faceness of the cells beside
/// it.
[[nodiscard]] double SeenShare(const LoopField& field, const Eigen::Vector2d& a,
                               const Eigen::Vector2d& b);

}  // namespace enfilade
