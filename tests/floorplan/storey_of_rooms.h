// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Rooms 0, 1, … from floor 0 to ceiling 2.4, their edges as walls in ring order, seen,
/// 12 cm thick, σ 2 cm.
[[nodiscard]] Storey StoreyOf(const std::vector<Polygon2>& polygons);

}  // namespace enfilade
