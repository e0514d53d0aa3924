// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/pair_selection.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/floor_picture.h"

namespace enfilade {

/// Where the floors of two panoramas lie on each other best.
struct FloorPlace {
  int turn = 0;  ///< quarter turns (YawOfTurn)
  /// From a's middle to b's in a's picture, pixels: right, down.
  Eigen::Vector2d step_px{0, 0};
  double digits = 0;  ///< how clear it is, as PanoPair::log10_chance counts
};

/// A spot that both floors show, on the floors' pictures: right and down of their middles, pixels.
struct FloorSpot {
  Eigen::Vector2d a_px{0, 0}, b_px{0, 0};
};

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

/// Spots of a regular grid that look the same in both pictures, to a part of a pixel.
[[nodiscard]] std::vector<FloorSpot> FindFloorSpots(const FloorPicture& a, const FloorPicture& b,
                                                    const FloorPlace& place);

/// The floors of pairs of panoramas, laid on each other (PlaceFloors). Of those that chance does
/// not explain spots of the floor are added to the rays of both views' features, which thereby have
/// rays without descriptors. Headings must be those with which the floors were looked at. In the
/// order of the pairs; runs in parallel.
[[nodiscard]] std::vector<FloorMatch> MatchFloors(std::span<const FloorPicture> floors,
                                                  std::span<const ViewPair> pairs,
                                                  std::span<const Gravity> gravity,
                                                  RunContext& context,
                                                  std::vector<PanoFeatures>& features);

}  // namespace enfilade
