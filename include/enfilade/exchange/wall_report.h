// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/floorplan/explain_wall.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// The evidence of a wall for people: several lines, ends in a line feed.
[[nodiscard]] std::string FormatWallReport(const Scene& scene, const WallExplanation& why);

/// The part of the plan around the wall, with the panoramas that see it, their field of view on the
/// wall, and where each of their columns has it: green within 5 %, orange else. One unit is a
/// millimetre at 1:50.
[[nodiscard]] std::string FormatWallSvg(const Floorplan& plan, const Scene& scene,
                                        const WallExplanation& why);

}  // namespace enfilade
