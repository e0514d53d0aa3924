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

namespace enfilade {

/// The loops of one core on the grid.
struct GridOutline {
  GridLoopOutcome outcome = GridLoopOutcome::kNoRoute;
  std::vector<GridVertex> outer;                 ///< counter-clockwise
  std::vector<std::vector<GridVertex>> islands;  ///< counter-clockwise round solid wall inside
  int num_inner_walls = 0;
  int64_t num_settled = 0;
};

/// The outline round the cells `core`. Cells of `foreign` belong to others and are not entered.
[[nodiscard]] GridOutline FindOutline(const LoopField& field, const ImageU8& core,
                                      const ImageU8& foreign, const FloorplanOptions& options,
                                      RunContext& context);

}  // namespace enfilade
