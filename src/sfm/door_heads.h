// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/sfm/gravity.h"

namespace enfilade {

/// A straight upright edge of a panorama in its level frame.
struct UprightEdge {
  double azimuth_rad = 0;
  double bottom = 0, top = 0;  ///< tangents of the elevations of its ends, bottom < top
};

/// The segments within 1° of the vertical, pieces of one edge joined. Cost: O(segments²).
[[nodiscard]] std::vector<UprightEdge> UprightEdges(std::span<const LineSegment> segments,
                                                    const Eigen::Matrix3d& level_from_cam);

/// Height of door heads above the floor in camera heights, from the upright edges of every
/// panorama; none where too few stand out.
///
/// An edge that starts on the floor tells the height of its end: 1 − top / bottom camera heights
/// above the floor, whatever its distance. Door frames are in every room and all end at one height,
/// while cupboards and windows differ: the height at which most panoramas have ends, at most three
/// counted in each, is that of the door heads. Among heights that stand out equally the one nearest
/// to `usual` (camera heights; 10 %) is taken, and where two lie one casing's width apart, as the
/// two edges of a frame's trim do, the lower.
[[nodiscard]] std::optional<double> FindDoorHead(
    std::span<const std::vector<UprightEdge>> edges_of_panoramas, double usual);

}  // namespace enfilade
