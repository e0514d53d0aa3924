// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "enfilade/synthetic/home.h"
#include "src/synthetic/furniture.h"
#include "src/synthetic/placement.h"

namespace enfilade {

/// Whether a piece may hang or stand before a window that it overlaps.
enum class BeforeWindows { kForbidden, kAllowed };

/// Fixes pieces to the walls of one room of a home, where they are in nobody's way: inside the
/// room, clear of doors, of windows, of what is there at the same height and of the cameras.
class WallFitter {
 public:
  /// `home` must outlive it and keep its rooms and openings.
  WallFitter(Home& home, const HomeRoom& room);

  [[nodiscard]] const std::vector<HomeWall>& walls() const { return walls_; }

  /// Fixes the piece with its middle `middle_m` from the start of a wall of the room, to stay when
  /// the furniture is gone. Returns false, with the home as it was, when there is no room for it.
  bool FixAt(const HomeWall& wall, double middle_m, const FurniturePiece& piece,
             BeforeWindows before_windows = BeforeWindows::kForbidden);

  /// As FixAt, anywhere along the walls, every other time in a corner.
  bool FixSomewhere(const FurniturePiece& piece, Random& random);

 private:
  struct WindowHole {
    Ring2 before;  ///< floor before it
    double sill_z = 0, head_z = 0;
  };

  [[nodiscard]] bool IsClearOfOpenings(const Ring2& ring, std::pair<double, double> z,
                                       BeforeWindows before_windows) const;
  [[nodiscard]] bool IsClearOfThings(const Ring2& ring, std::pair<double, double> z) const;
  [[nodiscard]] bool IsClearOfCameras(const Ring2& ring, double reach_m) const;

  Home& home_;
  const HomeRoom& room_;
  std::vector<HomeWall> walls_;
  std::vector<WindowHole> windows_;
};

}  // namespace enfilade
