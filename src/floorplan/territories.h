// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/image/image.h"

namespace enfilade {

/// The cells of every core; of a core in several pieces, the largest.
[[nodiscard]] std::vector<ImageU8> SeparateCores(const EvidenceGrids& evidence);

/// For every cell the core from which it is reached most easily, walls being hard to pass: cores
/// meet in the middle of the wall between them. `solid` says how sure a wall is, 0–1.
[[nodiscard]] ImageI AssignTerritories(const ImageF& solid, const std::vector<ImageU8>& cores);

/// The cells of all territories but one.
[[nodiscard]] ImageU8 ForeignCells(const ImageI& territories, int own);

}  // namespace enfilade
