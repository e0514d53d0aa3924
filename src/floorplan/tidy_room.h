// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "enfilade/geometry/boolean.h"
#include "src/floorplan/slide.h"

namespace enfilade {

/// The largest part of a region as a room among others, of which `own` is the one that it takes the
/// place of: without needless vertices, jogs straightened (StraightenJogs) unless a wall put in
/// line would run into another room. Empty if it does even so.
[[nodiscard]] Polygon2 TidyRoom(const MultiPolygon2& region, double min_jog_m,
                                const WallWeight& weight, std::optional<size_t> own,
                                const std::vector<Polygon2>& rooms);

}  // namespace enfilade
