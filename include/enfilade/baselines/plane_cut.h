// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What the cut pays. Numbers of points and rays, and lambda, are those of cells of
/// reference_cell_m and are brought to the cells of the evidence.
struct PlaneCutOptions {
  double lambda = 100;
  double good_wall_points = 0;
  double good_free_rays = 0;
  double good_wall_share = 1;
  double good_free_share = 0.25;
  double reference_cell_m = 0.013;
  double log_odds_scale = 100;
  double min_hole_m2 = 0.25;
  double min_room_m2 = 0.25;

  void Visit(OptionVisitor& v);
};

enum class PlaneCutOutcome { kFound, kNoRoom };
[[nodiscard]] std::span<const std::string_view> EnumNames(PlaneCutOutcome);

struct PlaneCutReport {
  PlaneCutOutcome outcome = PlaneCutOutcome::kNoRoom;
  std::string reason;    ///< one line; empty when there is a room
  int num_parts = 0;     ///< connected parts inside, in all storeys
  int num_rooms = 0;     ///< of them, those that hold a camera and are large enough
  int64_t cut_cost = 0;  ///< of all storeys
  int64_t num_augmentations = 0;
  Floorplan plan;
};

/// The rival of the paper: every cell of the evidence is inside or outside, and the borders between
/// are as short as the evidence lets them be. Minimises, exactly,
///
///   Σ_inside wall(c) + Σ_outside free(c) + λ · number of sides between inside and outside
///
/// over the cells of each storey; those at the grid's border are outside. Each connected part that
/// holds a camera is a room, its outline the border of its cells: no vertex is dear here, so
/// outlines follow every cell. Walls stay on the grid.
///
/// Evidence of raw counts x is scaled to 100 · clamp(x / x_good − 0.5, 0, 2.55). Where the number
/// that makes a cell good is 0 it is a share of the mean of the cells with any. Log-odds l of a
/// wall face and of free space are costs as they are, wall(c) − free(c) = log_odds_scale · (l_wall
/// − l_free).
///
/// `evidence` has one entry a storey of `structure`. Guarantees: rings are simple and rooms of a
/// storey disjoint; the same result for any number of threads. Of cuts that cost the same the one
/// with least inside. Cost: see FindGridCut.
///
/// The volumetric graph cut of Furukawa, Curless, Seitz & Szeliski ("Reconstructing Building
/// Interiors from Images", ICCV 2009) in the plane, as Cabral & Furukawa (CVPR 2014, supplement,
/// Fig. 7) compare with it at λ, 4λ and 16λ; numbers after the authors' prototype
/// (docs/algorithms/baselines.md).
[[nodiscard]] PlaneCutReport CutFloorplan(const Scene& scene, const Structure& structure,
                                          const std::vector<EvidenceGrids>& evidence,
                                          const PlaneCutOptions& options, RunContext& context);

}  // namespace enfilade
