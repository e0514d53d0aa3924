// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace enfilade {

/// What is known of where the walls about a panorama are: distance for each of any number of
/// columns (AzimuthOfColumn); empty when nothing is known.
using KnownDistances = std::vector<double>;

/// The column of num_columns (AzimuthOfColumn) that looks along a ray.
[[nodiscard]] int ColumnOf(const Eigen::Vector2d& ray, int num_columns);

/// The known distance in the direction of a ray. Requires that something is known.
[[nodiscard]] double DistanceTowards(const KnownDistances& known, const Eigen::Vector2d& ray);

/// Indices of the other positions, nearest first.
[[nodiscard]] std::vector<int> NearestOthers(std::span<const Eigen::Vector2d> positions,
                                             size_t self);

/// Walls seen at an angle whose sine is smaller than this are not compared between panoramas.
inline constexpr double kMinIncidenceSin = 0.15;

/// A point of an upright wall that one panorama supposes and another is asked about.
struct WallPoint {
  Eigen::Vector2d point{0, 0};
  Eigen::Vector2d normal{0, 0};  ///< unit, to either side
  Eigen::Vector2d seen_from{0, 0};
};

/// Whether a panorama at `position` would see the point, on the side of the wall that it is seen
/// from: within `max_range_m`, not at a grazing angle, and not behind the walls that are known
/// about that panorama.
[[nodiscard]] bool WouldSee(const WallPoint& wall, const Eigen::Vector2d& position,
                            const KnownDistances& known, double max_range_m);

}  // namespace enfilade
