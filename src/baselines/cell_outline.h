// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "enfilade/floorplan/cells.h"
#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"

namespace enfilade {

/// The number of cells that make up an area.
[[nodiscard]] size_t CellsOf(double area_m2, double cell_m);

/// Sets cells so that no two set cells touch at a corner alone: of the two others at such a corner
/// the one in the lower row.
void JoinCorners(ImageU8& cells);

/// Sets 4-connected parts of unset cells that lie in less than `min_cells` and not at the border.
void FillSmallHoles(size_t min_cells, ImageU8& cells);

/// The border of a 4-connected set of cells.
struct CellOutline {
  std::vector<GridVertex> outer;               ///< counter-clockwise
  std::vector<std::vector<GridVertex>> holes;  ///< clockwise
};

/// Requires that no two cells of the set touch at a corner alone (JoinCorners). Then rings are
/// simple and have no vertex in common; each vertex is a corner.
[[nodiscard]] CellOutline TraceOutline(int rows, int cols, const CellSet& set);

}  // namespace enfilade
