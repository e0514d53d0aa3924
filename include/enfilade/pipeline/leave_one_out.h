// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/pipeline/options.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// True when enough panoramas of its storey are left to plan without this one: two, since the
/// height of the floor is found from distances between cameras.
[[nodiscard]] bool CanPlanWithout(const Scene& scene, int view_idx);

/// The plan of the home made without one panorama: structure, evidence and floorplan from the
/// pictures, poses and points of all others, none of which has heard of it. Points that it alone
/// saw are left out. The plan is empty when nothing was found.
///
/// Requires CanPlanWithout. Throws IoError or InvalidInputError when a picture cannot be read,
/// StoppedError. Costs as much as these stages for the others.
[[nodiscard]] Floorplan PlanWithout(const Scene& scene, int view_idx,
                                    const PipelineOptions& options, RunContext& context);

}  // namespace enfilade
