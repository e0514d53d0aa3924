// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "enfilade/model/visibility.h"
#include "enfilade/scene/types.h"
#include "src/model/chart.h"

namespace enfilade {

/// A view as texturing uses it: its camera in the home frame.
struct TextureView {
  Camera camera;
  Eigen::Matrix3d cam_from_home;  ///< rotation
  Eigen::Vector3d position{0, 0, 0};
  double pixels_per_rad = 1;  ///< at the middle of the picture
  double last_row = 0;        ///< pixels below it show the camera's stand

  /// Pixel that shows the point, none when the picture does not show it.
  [[nodiscard]] std::optional<Eigen::Vector2d> PixelOf(const Eigen::Vector3d& in_home) const;
};

[[nodiscard]] TextureView MakeTextureView(const View& view, const Rigid3& home_from_world,
                                          double stand_row);

/// A tile is looked at in a grid of this many samples a side.
inline constexpr int kTileSamples = 3;
inline constexpr int kAllSamples = (1 << kTileSamples * kTileSamples) - 1;

/// What one view shows of one tile.
struct TileView {
  uint16_t seen = 0;  ///< bit per sample
  float log_quality =
      0;  ///< log of picture resolution, lowered for slanting views; higher is better
  Eigen::Vector3f rgb{0, 0, 0};  ///< mean over the samples seen, in 0–255
};

/// What one view shows of one chart, tile by tile (row by row).
struct ChartView {
  int view_idx = 0;
  std::vector<TileView> tiles;
};

/// A chart with the views that see any of it, in the order of the views.
struct ChartViews {
  std::vector<uint16_t> inside;  ///< per tile: bit per sample that lies in the face
  std::vector<ChartView> views;
};

/// Place of a tile's sample in texels, kept within the chart.
[[nodiscard]] Eigen::Vector2d SampleTexel(const Chart& chart, int tile_row, int tile_col,
                                          int sample);

/// Which views see which tiles, and how well, by geometry alone (rgb stays zero).
[[nodiscard]] ChartViews FindChartViews(const Chart& chart, const ModelFace& face,
                                        const Scene& scene, const std::vector<TextureView>& views,
                                        const Visibility& visibility);

/// Fills rgb of one view in all charts from its picture, and clears samples that `mask` (may be
/// empty) rules out.
void SampleTileColours(const ImageU8& picture, const ImageU8& mask, int view_idx,
                       const TextureView& view, const std::vector<Chart>& charts,
                       std::vector<ChartViews>& chart_views);

/// Index into `views` for every tile, −1 where no view sees any of it: the labelling with least
/// cost of resolution lost, disagreement with the other views (gains applied) and seams.
[[nodiscard]] std::vector<int> ChooseViews(const Chart& chart, const ChartViews& chart_views,
                                           const std::vector<Eigen::Vector3d>& gains,
                                           double seam_cost);

/// One factor on R, G, B per view that makes the views agree where they see the same tiles, weakly
/// drawn to 1 and kept in [0.6, 1.6].
[[nodiscard]] std::vector<Eigen::Vector3d> EstimateGains(const std::vector<ChartViews>& chart_views,
                                                         size_t num_views);

}  // namespace enfilade
