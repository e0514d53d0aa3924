// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/types.h"
#include "src/floorplan/box_index.h"

namespace enfilade {

/// Finds closets that would lie behind walls of a storey, which is not owned and must not change.
class ClosetFinder {
 public:
  ClosetFinder(const FloorplanOptions& options, const Storey& storey);

  /// The closet behind a wall: where rooms go on past it beside one of its ends or both, up to
  /// where the first of them ends. wall_thickness_m away from every room, at most unseen_gap_m deep
  /// and unseen_hole_m2 large, at least as wide and large as a closet (closet.h); empty where none
  /// has room, and where more of other walls lies in line with its front than with its back.
  [[nodiscard]] Polygon2 Behind(const Wall& wall) const;

 private:
  [[nodiscard]] double DepthBeside(const Eigen::Vector2d& end, const Eigen::Vector2d& aside,
                                   const Eigen::Vector2d& outward) const;
  [[nodiscard]] double LengthInLine(const Eigen::Vector2d& on_line, const Wall& wall) const;

  const FloorplanOptions& options_;
  const Storey& storey_;
  BoxIndex rooms_, walls_;
};

/// Adds the closets behind doors that lead into no room: a door leads somewhere. Their walls are
/// inferred, their heights those of the room before them. Rooms, walls and openings keep their ids,
/// new ones follow; walls learn what lies behind them (MeasureThickness). Returns how many.
int AddShutClosets(const FloorplanOptions& options, Storey& storey);

}  // namespace enfilade
