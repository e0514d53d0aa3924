// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/synthetic/home.h"
#include "src/synthetic/rectangle.h"

namespace enfilade {

/// The bounds of all rooms along the home's axes. There must be one.
[[nodiscard]] Rectangle GroundOf(const Home& home);

/// Puts homes of one storey each, with level ceilings, on top of each other: the one whose bounds
/// take most ground lowest, the others centred over it. Heading, sun and baseboards of all are
/// those of the lowest. There must be one.
[[nodiscard]] Home StackStoreys(std::vector<Home> storeys);

}  // namespace enfilade
