// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/evidence/grid.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"

namespace enfilade {

using ImageI = Image<int>;

/// A ring of cell corners as lengths.
[[nodiscard]] Ring2 RingInMetres(const GridFrame& frame, const std::vector<GridVertex>& ring);

/// 1 for the cells inside a ring of cell corners.
[[nodiscard]] ImageU8 CellsInside(int rows, int cols, const std::vector<GridVertex>& ring);

/// The cells of one 4-connected set, as indices row · cols + col in ascending order.
using CellSet = std::vector<int>;

/// The 4-connected components of cells with the same value but zero, in the order of their first
/// cell. For uint8_t and uint16_t.
template <typename T>
[[nodiscard]] std::vector<CellSet> ConnectedCells(const Image<T>& cells);

/// Cheapest ways over cell sides from sources.
struct CellWays {
  ImageF cost;    ///< sum over the cells entered; infinity where there is no way
  ImageI source;  ///< label of the source, −1 where there is no way
  ImageI parent;  ///< index of the previous cell, −1 at sources
};

/// Dijkstra over 4-neighbours. `cell_cost` is what entering a cell costs, negative where no way
/// leads through; cells with source ≥ 0 are where ways start. Ties are broken by the cells' order.
[[nodiscard]] CellWays FindCellWays(const ImageF& cell_cost, ImageI source);

}  // namespace enfilade
