// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "enfilade/base/run_context.h"
#include "src/floorplan/pictured_wall.h"

namespace enfilade {

/// Keeps what pictures show of walls, so that a wall that stays where it is while others move is
/// looked at once. Walls are the same if their room, heights and step are. What a store holds
/// changes no result.
class FacadeStore {
 public:
  /// Keeps at most 256 MB, and a quarter of the context's memory cap if it has one.
  explicit FacadeStore(const RunContext& context);

  /// Moves the facade of the same wall into this one, if it is kept. Returns whether it is.
  bool Take(PicturedWall& wall);

  /// Keeps the wall's facade, which must be finished, while there is room.
  void Keep(PicturedWall&& wall);

 private:
  using Key = std::array<double, 8>;  // storey, ends, heights, step
  struct Kept {
    Polygon2 room;
    Facade facade;
  };
  [[nodiscard]] static Key KeyOf(const PicturedWall& wall);

  size_t free_bytes_ = 0;
  std::map<Key, Kept> kept_;
};

}  // namespace enfilade
