// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// How evidence is drawn from a known plan.
struct DrawOptions {
  double cell_m = 0.025;
  double margin_m = 1;
  double log_odds = 3;          ///< of everything that is known
  double solid_depth_m = 0.12;  ///< how far behind faces cells are known to be solid
  double face_blur_m = 0;       ///< standard deviation of faces across walls
  double noise = 0;             ///< standard deviation added to all log-odds
  double core_distance_m = 0.1;
  uint32_t seed = 1;
};

/// The evidence that perfect profiles of the free region would leave: free space inside, faces
/// along its rings, solid wall just behind, nothing known beyond. One core for each part of the
/// region eroded by core_distance_m.
[[nodiscard]] EvidenceGrids DrawEvidence(const MultiPolygon2& free,
                                         const DrawOptions& options = {});

/// The same as raw counts, with cameras: 7 points in the cells beside the rings, 40 rays across
/// free cells but those within 5 cm of a wall, all free space sure.
[[nodiscard]] EvidenceGrids DrawCounts(const MultiPolygon2& free,
                                       const std::vector<Eigen::Vector2d>& cameras,
                                       const DrawOptions& options = {});

/// Forgets the core within `region`: nobody stands there.
void EraseCore(const Polygon2& region, EvidenceGrids& grids);

/// Forgets everything within `region` but the core.
void EraseEvidence(const Polygon2& region, EvidenceGrids& grids);

/// Adds `free` and `wall` log-odds to the cells within `region`.
void AddEvidence(const Polygon2& region, float free, float wall, EvidenceGrids& grids);

[[nodiscard]] Polygon2 Box(double min_x, double min_y, double max_x, double max_y);

}  // namespace enfilade
