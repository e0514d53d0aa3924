// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "enfilade/optim/grid_loop.h"

namespace enfilade {

inline constexpr int kRowStep[4] = {0, 1, 0, -1};  ///< by GridHeading
inline constexpr int kColStep[4] = {1, 0, -1, 0};

[[nodiscard]] inline GridVertex Moved(const GridVertex& from, GridHeading heading, int steps = 1) {
  const auto h = static_cast<size_t>(heading);
  return {from.row + steps * kRowStep[h], from.col + steps * kColStep[h]};
}

[[nodiscard]] inline GridHeading TurnedLeft(GridHeading heading) {
  return static_cast<GridHeading>((static_cast<int>(heading) + 1) & 3);
}
[[nodiscard]] inline GridHeading TurnedRight(GridHeading heading) {
  return static_cast<GridHeading>((static_cast<int>(heading) + 3) & 3);
}
[[nodiscard]] inline GridHeading Reversed(GridHeading heading) {
  return static_cast<GridHeading>(static_cast<int>(heading) ^ 2);
}

/// The cells (row, col) beside the step that leaves `from` with `heading`.
[[nodiscard]] inline GridVertex LeftCell(const GridVertex& from, GridHeading heading) {
  constexpr int kRow[4] = {0, 0, -1, -1}, kCol[4] = {0, -1, -1, 0};
  const auto h = static_cast<size_t>(heading);
  return {from.row + kRow[h], from.col + kCol[h]};
}
[[nodiscard]] inline GridVertex RightCell(const GridVertex& from, GridHeading heading) {
  constexpr int kRow[4] = {-1, 0, 0, -1}, kCol[4] = {0, 0, -1, -1};
  const auto h = static_cast<size_t>(heading);
  return {from.row + kRow[h], from.col + kCol[h]};
}

}  // namespace enfilade
