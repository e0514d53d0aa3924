// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/paper_field.h"

namespace enfilade {

/// The closed free space about a core: cells that rays pass, gaps between them closed and thin
/// leaks opened, as far as it hangs together with the core; holes filled. Clear of the grid's
/// border and of `foreign` cells, but it always holds the core.
[[nodiscard]] ImageU8 ClosedFreeSpace(const PaperField& field, const ImageU8& core,
                                      const ImageU8& foreign);

/// The outer contour of a 4-connected region without holes: all its vertices, one step apart,
/// counter-clockwise. It may touch itself where cells meet at a corner.
[[nodiscard]] std::vector<GridVertex> TraceContour(const ImageU8& region);

}  // namespace enfilade
