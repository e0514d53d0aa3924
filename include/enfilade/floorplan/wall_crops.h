// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "enfilade/floorplan/types.h"
#include "enfilade/floorplan/wall_witness.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// What the pictures show about a wall: for each of the first `max_crops` witnesses the part of its
/// picture around the wall, level (azimuth across, elevation down), with the wall's outline in the
/// plan drawn over it in red; one below the other, up to 640 pixels wide, RGB.
///
/// The pictures' files are read (view.path). Throws what reading pictures throws.
[[nodiscard]] ImageU8 DrawWallCrops(const Scene& scene, const Rigid3& home_from_world,
                                    const Room& room, const Wall& wall,
                                    std::span<const WallWitness> witnesses, size_t max_crops = 8);

}  // namespace enfilade
