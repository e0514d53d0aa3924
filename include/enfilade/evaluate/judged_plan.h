// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// Two points in the plan, metres.
using Segment2 = std::array<Eigen::Vector2d, 2>;

struct JudgedRoom {
  MultiPolygon2 region;             ///< inside the inner wall faces
  std::optional<double> ceiling_m;  ///< height above the floor; none where it is not level
};

/// What truth and result have in common, both brought to the truth's world, so that they are
/// treated alike. All storeys lie on one another.
struct JudgedPlan {
  std::vector<JudgedRoom> rooms;
  std::vector<Segment2> walls;  ///< wall faces; doors and openings left out, windows not
  std::vector<Segment2> doors;  ///< those with centres within 0.4 m are one
};

/// How far the face of a wall may lie from a door or opening that was cut into it: openings are
/// drawn on one face, in the middle or across, and walls are up to this thick.
inline constexpr double kOpeningReach_m = 0.35;

/// Walls are compared when their directions differ by no more than this.
inline constexpr double kMaxWallAngle_rad = 0.5235987755982988;  // 30°

/// Doors whose centres are within this are one, and a found door is a hit.
inline constexpr double kDoorDistance_m = 0.4;

/// Rooms joined by a wide opening become one, with the ceiling of the largest.
[[nodiscard]] JudgedPlan JudgedPlanOf(const GroundTruth& truth);

/// Polygons are brought from the home frame to the world. Rooms become one as in the truth; the
/// walls are the outlines of the rooms as they stand, less doors and openings.
[[nodiscard]] JudgedPlan JudgedPlanOf(const Floorplan& floorplan);

/// The parts of `segments` that lie in none of `openings`: an opening takes out what it covers,
/// seen square on, of each segment within kOpeningReach_m whose direction is within 30° of its own.
[[nodiscard]] std::vector<Segment2> CutOpenings(const std::vector<Segment2>& segments,
                                                const std::vector<Segment2>& openings);

/// What the opening takes out of each segment, by the same rule.
[[nodiscard]] std::vector<Segment2> PartsBehind(const Segment2& opening,
                                                const std::vector<Segment2>& segments);

/// All edges of a region's rings.
[[nodiscard]] std::vector<Segment2> OutlineOf(const MultiPolygon2& region);

/// True when the undirected directions of two segments differ by at most kMaxWallAngle_rad.
[[nodiscard]] bool AreParallelWalls(const Segment2& a, const Segment2& b);

/// One door for all whose centres are linked by steps under kDoorDistance_m: the longest of them.
[[nodiscard]] std::vector<Segment2> MergeDoors(const std::vector<Segment2>& doors);

}  // namespace enfilade
