// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "src/floorplan/loop_field.h"

namespace enfilade {

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
