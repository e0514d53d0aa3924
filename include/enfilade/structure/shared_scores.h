// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/structure/column_scores.h"
#include "enfilade/structure/plane_viterbi.h"
#include "enfilade/structure/wall_sight.h"

namespace enfilade {

struct SharedScoresOptions {
  int max_views = 4;
  double max_view_distance_m = 8.0;
  double contradiction = 0.4;
  double past_margin_m = 0.3;

  void Visit(OptionVisitor& v) {
    v("max_views", max_views, "Most panoramas that are asked about a wall.", {1, 32});
    v("max_view_distance_m", max_view_distance_m, "Farthest panorama that is asked, metres.",
      {0.1, 100.0});
    v("contradiction", contradiction,
      "Response that something loses that does not reach the ceiling and past which others see.",
      {0.0, 10.0});
    v("past_margin_m", past_margin_m, "How far past it they must see, metres.", {0.0, 5.0});
  }
};

/// The scores of one panorama and where it stands.
struct PlacedScores {
  Eigen::Vector2d position{0, 0};
  const ColumnScores* scores = nullptr;
};

/// What other panoramas say to a wall: for each family, column and distance of panorama `self` the
/// mean, over up to max_views panoramas that would see that point of that wall, of their own scores
/// there. A bin that covers several of the other's bins takes the strongest. Panoramas that see
/// past the point, to a wall behind it, contradict instead: up to `contradiction` is taken off,
/// less where the panorama itself sees the wall meet the ceiling (furniture does not). Zero where
/// nobody would see the point. The frontal family is left out: its planes are no planes seen from
/// elsewhere. Computed every `column_step` columns and repeated between.
///
/// `others` are indices into `views` sorted by preference (nearest first); `known` has one entry a
/// view; `own_ceiling` is the response of this panorama's ceiling line, null when not known.
[[nodiscard]] ColumnScores ShareScores(std::span<const PlacedScores> views, int self,
                                       std::span<const int> others,
                                       std::span<const KnownDistances> known,
                                       const ColumnScores* own_ceiling, int column_step,
                                       const DistanceBins& bins,
                                       const SharedScoresOptions& options);

/// The same for one path only: the mean over its columns of what others say to its walls.
/// Contradictions count in full.
[[nodiscard]] double ShareOfPath(std::span<const PlacedScores> views, int self,
                                 const WallPath& path, std::span<const int> others,
                                 std::span<const KnownDistances> known, const DistanceBins& bins,
                                 const SharedScoresOptions& options);

}  // namespace enfilade
