// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/structure/column_scores.h"
#include "enfilade/structure/level_panorama.h"
#include "enfilade/structure/wall_sight.h"

namespace enfilade {

struct StripCorrelationOptions {
  int max_views = 4;
  double max_view_distance_m = 8.0;
  double half_width_deg = 3.5;
  double below_m = 1.1;
  double above_m = 0.7;
  double noise = 3.0;
  double shading = 7.5;

  void Visit(OptionVisitor& v) {
    v("max_views", max_views, "Most panoramas that a strip is compared with.", {1, 32});
    v("max_view_distance_m", max_view_distance_m, "Farthest panorama it is compared with, metres.",
      {0.1, 100.0});
    v("half_width_deg", half_width_deg, "Half the width of a strip, degrees.", {0.1, 20.0});
    v("below_m", below_m, "How far below the cameras a strip reaches, metres.", {0.0, 3.0});
    v("above_m", above_m, "How far above the cameras a strip reaches, metres.", {0.0, 3.0});
    v("noise", noise, "Standard deviation of grey levels that carries no information.",
      {0.0, 50.0});
    v("shading", shading,
      "Standard deviation of grey levels along a strip that slow shading of a bare wall may have.",
      {0.0, 100.0});
  }
};

/// One panorama prepared for comparison: for every azimuth and every distance of an upright line,
/// the grey levels along that line at fixed heights.
class StripTable {
 public:
  static constexpr int kNumAzimuths = 1024;
  static constexpr int kNumHeights = 20;

  /// The heights run from `bottom_z` to `top_z` in the panorama's frame; the same for all tables
  /// that are compared.
  StripTable(const LevelPanorama& panorama, double bottom_z, double top_z,
             const DistanceBins& bins);

  [[nodiscard]] const Eigen::Vector2d& position() const { return position_; }
  [[nodiscard]] const uint8_t* line(int azimuth, int bin) const {
    return grey_.data() + (static_cast<size_t>(azimuth) * static_cast<size_t>(num_bins_) +
                           static_cast<size_t>(bin)) *
                              kNumHeights;
  }

 private:
  Eigen::Vector2d position_;
  int num_bins_;
  std::vector<uint8_t> grey_;  // kNumAzimuths × bins × kNumHeights
};

/// Correlation of wall strips with other panoramas: for each family, column and distance the wall
/// plane through that point carries a strip of this panorama into up to max_views others
/// that would see it; the score is the mean of the normalised cross-correlations of what varies
/// along the wall at each height, shrunk where the strip has less contrast than the noise. The
/// linear part of the variation counts only as far as it is stronger than shading, which agrees
/// with itself on every plane nearby. Families of `families`; columns computed every `column_step`
/// and repeated between.
///
/// `others` are indices into `tables` sorted by preference (nearest first); `known` has one entry a
/// table.
[[nodiscard]] ColumnScores CorrelateStrips(std::span<const StripTable> tables, int self,
                                           std::span<const int> others,
                                           std::span<const KnownDistances> known, int num_columns,
                                           int column_step, std::span<const int> families,
                                           const DistanceBins& bins,
                                           const StripCorrelationOptions& options);

}  // namespace enfilade
