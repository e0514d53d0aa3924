// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/floorplan/wall_sigma.h"
#include "enfilade/floorplan/wall_witness.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What the loop solver asks for edges of an outline, term by term (docs/algorithms/floorplan.md).
struct OutlineCost {
  double length_m = 0;
  double unseen_m = 0;         ///< length where no wall is seen
  double free_outside_m2 = 0;  ///< free space left outside, as far as one can look
  double solid_inside_m2 = 0;  ///< solid wall taken in
  int num_corners = 0;
  double total_m = 0;  ///< the terms with their weights, in metres of unseen wall
};

/// The plan without a wall: the wall moved along its normal to the next best place, the walls
/// beside it longer or shorter. Corners that fall together there are none.
struct NextBestWall {
  double outwards_m = 0;
  OutlineCost here;   ///< of the wall and the two beside it as they are
  OutlineCost there;  ///< and with the wall moved
};

/// Another wall's face behind the wall, looking away from it.
struct WallBehind {
  int wall_id = 0;
  int room_id = 0;
  double gap_m = 0;
};

struct WallExplanation {
  Wall wall;
  int storey_idx = 0;
  WallSigma sigma;
  std::vector<WallWitness> witnesses;  ///< those with most columns first
  int num_points = 0;                  ///< reconstructed points within 10 cm of the face
  OutlineCost cost;                    ///< of the wall, one of its corners counted
  std::optional<NextBestWall> next_best;
  std::optional<WallBehind> behind;
  std::vector<Opening> openings;  ///< on it
};

/// The wall's evidence. `wall_idx` is its place in the storey's
/// walls; `evidence` that of the storey.
[[nodiscard]] WallExplanation ExplainWall(const Scene& scene, const Structure& structure,
                                          const EvidenceGrids& evidence,
                                          const FloorplanOptions& options, const Floorplan& plan,
                                          int storey_idx, size_t wall_idx);

}  // namespace enfilade
