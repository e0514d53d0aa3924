// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "src/exchange/connection_facts.h"
#include "src/exchange/connection_sheet.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {

/// A line of the map, in millimetres on the sheet.
struct MapSegment {
  Eigen::Vector2d a{0, 0}, b{0, 0};
};

/// Short names beside the cameras of the panels, so that none covers another one or a camera, and
/// as few lines as can be. Styles: map-name with name-start, name-middle or name-end. Where there
/// is no space a name is left out; a panel that its names would crowd has none. The list of
/// pictures without ties always has its names.
[[nodiscard]] std::vector<TextLine> PlaceNames(const ConnectionFacts& facts, const MapSheet& sheet,
                                               std::span<const MapSegment> lines);

}  // namespace enfilade
