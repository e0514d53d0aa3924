// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/evidence/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// The wall profiles of one storey as samples for the evidence grids, in the plan of the home
/// frame: one a seen column, in the order of the views. Every sample carries the distribution of
/// its wall's distance, not only the best one.
[[nodiscard]] WallSampleSet MakeWallSamples(const Structure& structure, const Scene& scene,
                                            int storey_idx);

}  // namespace enfilade
