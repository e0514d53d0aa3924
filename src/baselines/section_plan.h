// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "enfilade/base/run_context.h"
#include "enfilade/baselines/surface_report.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// Makes the report's plan, as CutFloorplan makes its own, and sets outcome and reason. Rooms are
/// the parts of `section_at` that hold one of the storey's cameras and `min_room_m2`, at the median
/// height of these cameras in the home frame; on a storey without cameras there is none. Throws
/// what AccumulateEvidence throws.
void PlanFromSections(const Scene& scene, const Structure& structure,
                      const std::function<MultiPolygon2(double z)>& section_at, double min_room_m2,
                      RunContext& context, SurfaceReport& report);

}  // namespace enfilade
