// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/pair_selection.h"
#include "src/sfm/floor_picture.h"

namespace enfilade {

/// Where the floors of two panoramas lie on each other best.
struct FloorPlace {
  int turn = 0;  ///< quarter turns (YawOfTurn)
  /// From a's middle to b's in a's picture, pixels: right, down.
  Eigen::Vector2d step_px{0, 0};
  double scale = 1;   ///< of b's picture, as cameras do not stand equally high
  double digits = 0;  ///< how clear it is, as PanoPair::log10_chance counts
};

/// What the floor itself shows at the result, right and down of its middle, it shows at `px` once
/// it is turned by quarters (YawOfTurn).
template <typename Vector>
[[nodiscard]] Vector Unturned(Vector px, int turn) {
  for (int t = 0; t < turn; ++t) px = Vector(px.y(), -px.x());
  return px;
}

/// Tries all places of b's floor on a's at the four turns. Their likeness is the normalised
/// correlation times the root of the area that both show, as chance would have it the less, the
/// larger the area. What tells a true place is how far its likeness stands out from that of all
/// places more than a fifth of a camera height away: boards and tiles repeat, and are alike at
/// many. Masked correlation in the Fourier domain: Padfield, IEEE TIP 2012.
/// One place a pair, without digits where a picture is empty. Memory: 6 MB a panorama, of sixteen
/// at a time.
[[nodiscard]] std::vector<FloorPlace> PlaceFloors(std::span<const FloorPicture> floors,
                                                  std::span<const ViewPair> pairs,
                                                  RunContext& context);

}  // namespace enfilade
