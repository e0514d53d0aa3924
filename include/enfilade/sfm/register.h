// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/bundle_adjustment.h"
#include "enfilade/sfm/descriptor_matcher.h"
#include "enfilade/sfm/pair_selection.h"
#include "enfilade/sfm/tracks.h"
#include "enfilade/sfm/two_view.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

struct RegisterOptions {
  PairSelectionOptions selection;
  DescriptorMatchOptions match;
  TwoViewOptions two_view;
  BundleOptions bundle;
  bool use_guided = true;
  double guided_ratio = 0.85;
  double guided_deg = 0.2;
  double guided_reach = 5.0;

  void Visit(OptionVisitor& v) {
    v("selection", selection, "Which panoramas are matched.");
    v("match", match, "Matches between two panoramas.");
    v("two_view", two_view, "Pairs of panoramas.");
    v("bundle", bundle, "Refinement of all poses together.");
    v("use_guided", use_guided, "Match once more when poses are known.");
    v("guided_ratio", guided_ratio, "Ratio test of these matches: looser.", {0.5, 1.0});
    v("guided_deg", guided_deg,
      "They agree when their rays are this near to a common plane with the baseline.", {0.01, 3.0});
    v("guided_reach", guided_reach, "Farthest two panoramas matched so, in camera heights.",
      {0.1, 100.0});
  }
};

/// Panoramas placed by their pictures. Units are camera heights: the floor is z = 0 and the cameras
/// stand about 1 above it.
struct Registration {
  std::vector<Rigid3> world_from_cam;  ///< one a view; each component in a frame of its own
  std::vector<int> component_idx;      ///< one a view, the largest component is 0
  std::vector<PanoPair> pairs;         ///< all that were matched, with what became of them
  std::vector<Track> tracks;           ///< refined points
  std::vector<double> ceilings;        ///< heights of level ceilings that points show
  double ray_error_rad = 0;            ///< root mean square over the tracks
};

/// Places panoramas from their features: matching (of the pairs of SelectPairs), pairs on the
/// sphere (EstimatePair), rotations (AverageYaws), lengths from floor, ceiling and shared features,
/// positions, points, and rounds of bundle adjustment with ever stricter bounds, in which points
/// are found anew each time. Views that nothing ties to others are components of their own.
///
/// `followed` are matches that a film's tracks tell, beside those of the descriptors: one list for
/// some of the pairs. `floors` are places that floors tell, their spots among the features' rays
/// that have no descriptors.
[[nodiscard]] Registration RegisterFeatures(std::span<const PanoFeatures> features,
                                            std::span<const Gravity> gravity,
                                            const RegisterOptions& options, RunContext& context,
                                            std::span<const PairMatches> followed = {},
                                            std::span<const FloorMatch> floors = {});

/// Points and rounds of bundle adjustment from the poses and pairs that a registration has, then
/// matching once more with these poses, and both again; what RegisterFeatures ends with. Replaces
/// poses, tracks, ceilings and ray_error_rad, adds matches to pairs.
void RefineRegistration(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                        const RegisterOptions& options, RunContext& context,
                        Registration& registration);

}  // namespace enfilade
