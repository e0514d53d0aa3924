// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "enfilade/evaluate/judged_plan.h"

namespace enfilade {

/// F1 of rooms, corners and angles as papers on Structured3D report them.
struct Structured3dFigures {
  std::optional<double> room_f1, corner_f1, angle_f1;
};

/// The protocol of MonteFloor (Stekovic et al. 2021) as its users code it, on pictures of 256 × 256
/// pixels that each axis fills on its own: the extent of the true rooms, a tenth more on either
/// side, outside it clamped.
///
/// True rooms, from large to small, each take the result room of highest IoU above 0.5; rooms of
/// the result that still overlap another after an erosion by 5 × 5 are no hits. In hit rooms each
/// true corner claims the nearest corner of its room when it lies within 10 px, and its angle when
/// the two turn by the same within 5°. Rooms count by the outer ring of their largest part. Loose
/// and anisotropic (10 px are about half a metre on a home): for comparison with published figures.
/// None when a side has no room.
[[nodiscard]] Structured3dFigures EvaluateStructured3d(const JudgedPlan& result,
                                                       const JudgedPlan& truth);

}  // namespace enfilade
