// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// A length as floorplan.json holds it, so that what is computed from a plan in memory and from one
/// that was written and read is the same.
[[nodiscard]] inline double ToMicrometres(double length_m) {
  return std::round(length_m * 1e6) / 1e6 + 0.0;  // no negative zero
}

[[nodiscard]] inline Eigen::Vector2d ToMicrometres(const Eigen::Vector2d& p) {
  return {ToMicrometres(p.x()), ToMicrometres(p.y())};
}

[[nodiscard]] inline Polygon2 ToMicrometres(Polygon2 polygon) {
  for (Eigen::Vector2d& p : polygon.outer) p = ToMicrometres(p);
  for (Ring2& hole : polygon.holes) {
    for (Eigen::Vector2d& p : hole) p = ToMicrometres(p);
  }
  return polygon;
}

}  // namespace enfilade
