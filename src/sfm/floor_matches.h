// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/pair_selection.h"
#include "enfilade/sfm/register.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/floor_places.h"

namespace enfilade {

/// A spot that both floors show, on the floors' pictures: right and down of their middles, pixels.
struct FloorSpot {
  Eigen::Vector2d a_px{0, 0}, b_px{0, 0};
};

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

/// The same for all pairs of panoramas in one component, at the places that their poses tell: spots
/// that agree with each other, if they are several, replace those that a pair had, and a pair that
/// was refused counts again. Other features without descriptors are not expected. Returns the
/// number of pairs with spots. Runs in parallel.
int MatchFloorsAgain(std::span<const FloorPicture> floors, std::span<const Gravity> gravity,
                     RunContext& context, Registration& registration,
                     std::vector<PanoFeatures>& features);

}  // namespace enfilade
