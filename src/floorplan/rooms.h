// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

inline constexpr double kInferredSigma_m = 0.25;  ///< of the offset of a wall that nobody saw

/// What is said of a wall of whose length this share was seen.
[[nodiscard]] WallSeen SeenOf(double seen_share);

/// What profiles say about heights, at a camera's place in the plan.
struct HeightSample {
  Eigen::Vector2d position;
  double floor_z = 0;
  double ceiling_z = 0;
  double ceiling_weight = 0;
};

[[nodiscard]] std::vector<HeightSample> HeightSamples(const Scene& scene,
                                                      const Structure& structure, int storey_idx);

[[nodiscard]] std::vector<PlanCamera> PlanCameras(const Scene& scene);

/// A room without walls. Heights are weighted medians over the cameras inside, else those of the
/// storey.
[[nodiscard]] Room MakeRoom(const Polygon2& polygon, const StoreyStructure& heights,
                            const std::vector<HeightSample>& samples);

/// Appends a wall for every edge of the room's outline and holes, in ring order, numbered on, of
/// that thickness; the rest is as in a new Wall. Returns the index of the first.
size_t AppendWalls(const Room& room, double thickness_m, Storey& storey);

/// Adds a room (MakeRoom) and its walls to the storey.
void AddRoom(const LoopField& field, const Polygon2& polygon, const StoreyStructure& heights,
             const std::vector<HeightSample>& samples, const FloorplanOptions& options,
             Storey& storey);

}  // namespace enfilade
