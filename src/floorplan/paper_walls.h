// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/paper_field.h"

namespace enfilade {

/// The polygon, whose corners are corners of cells, with what raw counts say of its edges: how much
/// of each costs the path nothing, and how far the wall points beside it scatter.
[[nodiscard]] OutlineChoice MeasureOutline(const PaperField& field, const Polygon2& polygon,
                                           double cost_m);

}  // namespace enfilade
