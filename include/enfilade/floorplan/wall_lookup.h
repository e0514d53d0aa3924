// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// The wall of room `room_id` that the ring edge a → b of the room's polygon lies on: the one with
/// the longest common part, at equal length the one named first; null when none lies within
/// 1 cm of the edge along at least 1 cm. Cost linear in the storey's walls.
[[nodiscard]] const Wall* FindWallOfEdge(const Storey& storey, int room_id,
                                         const Eigen::Vector2d& a, const Eigen::Vector2d& b);

}  // namespace enfilade
