// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/scene/surface_label.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// True when z is between floor and ceiling, or at most 0.3 m below or above them.
[[nodiscard]] bool IsAtStorey(double z, double floor_z, double ceiling_z);

/// What a point is, from its height and normal (Cabral & Furukawa 2014, supplement). Floor and
/// ceiling: within 0.3 m of the height, normal within 15° of up or down. Wall: between the
/// heights, normal within 15° of horizontal. A point without a normal goes by its height alone: it
/// is wall where it is more than 0.3 m from both. Other: everything else, furniture above all.
[[nodiscard]] SurfaceLabel LabelOfPoint(const ScenePoint& point, double floor_z, double ceiling_z);

}  // namespace enfilade
