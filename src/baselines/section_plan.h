// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/baselines/surface_report.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// The median height of each storey's cameras in the home frame; of a storey without cameras the
/// middle between floor and ceiling.
[[nodiscard]] std::vector<double> CameraHeights(const Scene& scene, const Structure& structure);

/// Makes the parts of each storey's section that hold one of its cameras and `min_room_m2` the
/// rooms of the report's plan, as CutFloorplan makes its own, and sets outcome and reason. Throws
/// what AccumulateEvidence throws.
void TakeSections(const Scene& scene, const Structure& structure,
                  const std::vector<MultiPolygon2>& sections, double min_room_m2,
                  RunContext& context, SurfaceReport& report);

}  // namespace enfilade
