// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/paper_anchors.h"

namespace enfilade {

/// Index of the anchor to let go where a loop through all of them visits a vertex twice: the
/// weakest of those on the part between the two visits that holds fewer, such as a needle that
/// leads to a false wall; where one part holds none, the anchor that is passed next to the vertex.
/// Requires an anchor and a ring of corners that is not simple.
[[nodiscard]] size_t TangledAnchor(const std::vector<GridVertex>& ring,
                                   const std::vector<WallAnchor>& anchors);

}  // namespace enfilade
