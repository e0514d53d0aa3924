// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/room_outline.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

struct JoinOptions {
  double max_ratio = 0.9;
  double inlier_deg = 0.7;
  double min_log_odds = 22.0;
  double min_log_odds_overlapping = 33.0;
  double max_rival_share = 0.75;

  void Visit(OptionVisitor& v) {
    v("max_ratio", max_ratio, "Ratio test of matches between components: looser than within one.",
      {0.5, 1.0});
    v("inlier_deg", inlier_deg,
      "A match agrees when its rays are this near to a common plane with the baseline.",
      {0.05, 3.0});
    v("min_log_odds", min_log_odds,
      "Two components are joined when the natural logarithm of the odds for it is so large.",
      {0.0, 1000.0});
    v("min_log_odds_overlapping", min_log_odds_overlapping,
      "The same where more than a quarter of the smaller component's floor would lie on the "
      "other's.",
      {0.0, 1000.0});
    v("max_rival_share", max_rival_share,
      "No other way to join them may have more than this share of it.", {0.0, 1.0});
  }
};

/// Components as registration left them: all heights from one floor, metres, walls along x and y,
/// and nothing known of how one lies to another.
struct UnjoinedComponents {
  std::span<const Rigid3> world_from_cam;  ///< one a view, each component in its own frame
  std::span<const int> component_idx;      ///< one a view, from 0 on
  std::span<const PanoFeatures> features;  ///< one a view
  std::span<const Gravity> gravity;        ///< one a view
  std::span<const RoomOutline> outlines;   ///< one a view
  std::span<const PanoPair> pairs = {};    ///< that were matched, lengths in camera heights
  double camera_height_m = 1;
};

/// Two panoramas of joined components and the matches seen through the door between them.
struct DoorPair {
  int a_idx = 0, b_idx = 0;  ///< views, a_idx < b_idx
  std::vector<FeatureMatch> inliers;
};

/// One component tied to another.
struct ComponentJoin {
  int a = 0, b = 0;  ///< components, a < b
  Rigid3 a_from_b;   ///< turn about z and level shift, metres
  double log_odds = 0;
  std::vector<DoorPair> pairs;
};

/// Finds how components lie to each other from what their panoramas see through doors.
///
/// Through an ordinary door two rooms share too few features for any pair of panoramas to tell its
/// relative pose. Here all pairs of two components vote together, and the rooms' outlines leave few
/// places: what is seen lies on a room's surface, at a known distance, its features are as large as
/// the distances say, and all that is seen passes one door. Matches (looser than within a
/// component, wall by wall for each of the four turns that make the walls parallel) vote for a
/// level shift; the best places are refined and judged by the number n of different spots (30 cm)
/// seen through one door against the number e that mismatches would show (log-odds
/// n·ln(n/e) − (n − e)).
///
/// Rooms do not overlap, but the outline of a panorama at a passage covers parts of two: where
/// components would lie on each other a join needs more. Joins come strongest first and none closes
/// a circle.
[[nodiscard]] std::vector<ComponentJoin> JoinComponents(const UnjoinedComponents& components,
                                                        const JoinOptions& options,
                                                        RunContext& context);

}  // namespace enfilade
