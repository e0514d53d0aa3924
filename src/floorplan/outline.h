// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/territories.h"

namespace enfilade {

/// The loops of one core on the grid.
struct GridOutline {
  GridLoopOutcome outcome = GridLoopOutcome::kNoRoute;
  std::vector<GridVertex> outer;                 ///< counter-clockwise
  std::vector<std::vector<GridVertex>> islands;  ///< counter-clockwise round solid wall inside
  int num_inner_walls = 0;
  int64_t num_settled = 0;
};

/// The outline round a core, in the grid's vertices. Other cores' territories are not entered. Only
/// the part of the grid round the core is looked at: time and memory are linear in its cells.
[[nodiscard]] GridOutline FindOutline(const LoopField& field, const CoreMap& cores,
                                      const ImageI& territories, int core_idx,
                                      const FloorplanOptions& options, RunContext& context);

}  // namespace enfilade
