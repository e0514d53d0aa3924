// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/scene/surface_label.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What each of the scene's points is: LabelOfPoint with the floor and ceiling of the storey that
/// the first of its views is on. Other for points that no view sees. One label a point, in their
/// order.
[[nodiscard]] std::vector<SurfaceLabel> LabelPoints(const Scene& scene, const Structure& structure);

}  // namespace enfilade
