// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/paper.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/paper_field.h"

namespace enfilade {

/// The paper's outline of one core.
struct PaperOutline {
  GridLoopOutcome outcome = GridLoopOutcome::kNoRoute;  ///< of the first path
  ImageU8 core;                                         ///< hidden spaces included
  PaperLoop loop;
  std::vector<OutlineChoice> curve;  ///< ascending number of corners; not empty when found
  size_t automatic_idx = 0;          ///< the outline with the least cost and α a corner
  int64_t num_settled = 0;
};

/// First path, anchors, second path and the curve for every number of corners. No outline encloses
/// a cell of `foreign`. Requires a core that is 4-connected and not empty.
[[nodiscard]] PaperOutline SolvePaperLoop(const PaperField& field,
                                          const std::vector<EvidenceCamera>& cameras,
                                          const ImageU8& core, const ImageU8& foreign,
                                          double margin_m, const PaperOptions& options,
                                          RunContext& context);

}  // namespace enfilade
