// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "enfilade/base/errors.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// Makes the normal of a point that a file `where` holds unit; zero stays zero, for unknown. Throws
/// InvalidInputError, with the point's number, when position or normal is not finite.
inline void CheckCloudPoint(ScenePoint& point, size_t number, const std::string& where) {
  constexpr double kMaxDistance = 1e9;
  const double length = point.normal.norm();
  if (!(point.position.norm() <= kMaxDistance) || !std::isfinite(length)) {
    throw InvalidInputError(where,
                            "point " + std::to_string(number) +
                                " (from 0) has a position or a normal that is not finite",
                            "take such points out, for example with CloudCompare");
  }
  if (length > 0) point.normal /= length;
}

}  // namespace enfilade
