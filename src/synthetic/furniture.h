// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/synthetic/home.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// A piece of furniture in its own frame: x along its width, centred; y from its back (0) to its
/// front; z from the floor.
struct FurniturePiece {
  Eigen::Vector2d footprint{1, 1};  ///< width, depth
  bool is_against_wall = true;
  bool is_tall = false;  ///< hides a window
  std::vector<HomeBox> boxes;
};

/// What a room of that use may hold, most wanted first, with random sizes and colours. A kitchen
/// that is fitted already gets no further units.
[[nodiscard]] std::vector<FurniturePiece> FurnitureFor(RoomUse use, bool is_fitted, Random& random);

}  // namespace enfilade
