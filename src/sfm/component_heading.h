// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/sfm/gravity.h"

namespace enfilade {

/// A level line that some panorama sees: its direction in world, and how much of the picture it
/// spans.
struct LevelLine {
  double azimuth_rad = 0;  ///< modulo 180°
  double weight = 0;
};

/// The directions that a panorama's segments have if they are level, as most edges of rooms are
/// that do not stand upright. Segments near the vertical or near the horizon tell none.
[[nodiscard]] std::vector<LevelLine> LevelLines(std::span<const LineSegment> segments,
                                                const Eigen::Matrix3d& world_from_cam);

/// The azimuth modulo 90° along which most of the lines run, in [−45°, 45°); none where less than a
/// quarter of them (by weight) runs within 2° of it.
[[nodiscard]] std::optional<double> FindHeading(std::span<const LevelLine> lines);

}  // namespace enfilade
