// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/image/image.h"
#include "src/floorplan/grid_window.h"

namespace enfilade {

/// Where the cores lie.
struct CoreMap {
  ImageI core_of_cell;              ///< index of a core, −1 outside of all
  std::vector<GridWindow> windows;  ///< bounds of every core
};

/// The cores of the evidence; of a core in several pieces, the largest. Linear in the cells.
[[nodiscard]] CoreMap MapCores(const EvidenceGrids& evidence);

/// The cells of every core as an image of its own.
[[nodiscard]] std::vector<ImageU8> SeparateCores(const EvidenceGrids& evidence);

/// The inverse of SeparateCores: the core of each cell, −1 outside of all.
[[nodiscard]] ImageI CoreOfCells(const GridFrame& frame, const std::vector<ImageU8>& cores);

/// For every cell the core from which it is reached most easily, walls being hard to pass: cores
/// meet in the middle of the wall between them. `solid` says how sure a wall is, 0–1.
[[nodiscard]] ImageI AssignTerritories(ImageF solid, const ImageI& core_of_cell);

/// The cells of all territories but one.
[[nodiscard]] inline ImageU8 ForeignCells(const ImageI& territories, int own) {
  return CellsWhere(territories, [own](int core) { return core != own; });
}

}  // namespace enfilade
