// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "enfilade/floorplan/explain_wall.h"
#include "enfilade/floorplan/solve.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// What the loop solver would ask for the edge a → b, the room on its left, without corners; along
/// the grid the same up to its cells, and for any other direction the like of it. Adds up.
void AddEdgeCost(const LoopField& field, const FloorplanOptions& options, const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b, OutlineCost& cost);

void AddCornerCosts(const FloorplanOptions& options, int num_corners, OutlineCost& cost);

}  // namespace enfilade
