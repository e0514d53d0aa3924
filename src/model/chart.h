// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/image/image.h"
#include "enfilade/model/texture.h"
#include "enfilade/model/types.h"

namespace enfilade {

/// The rectangle of texels of one face, aligned with its plane, and its place in an atlas.
struct Chart {
  Eigen::Vector3d origin{0, 0, 0};                ///< the top left corner
  Eigen::Vector3d right{1, 0, 0}, down{0, 1, 0};  ///< unit, in the plane, as seen from the room
  double width_m = 0, height_m = 0;
  double texels_per_m = 1;
  int rows = 0, cols = 0;  ///< texels
  int tile_px = 1;         ///< side of a tile in texels
  int tile_rows = 0, tile_cols = 0;
  int atlas_idx = 0, atlas_row = 0, atlas_col = 0;  ///< of its first texel
  ImageU8 is_inside;  ///< rows × cols: 1 where the face covers the texel

  /// The point of the face at texel coordinates (the first texel's centre is 0.5, 0.5); coordinates
  /// beyond the rectangle give its border.
  [[nodiscard]] Eigen::Vector3d PointAt(double x, double y) const;
  [[nodiscard]] Eigen::Vector2d TexelOf(const Eigen::Vector3d& point) const;
};

/// Texels between a chart's border and its neighbour's are this many on each side, filled with
/// copies of the border, so that filtering does not mix charts.
inline constexpr int kChartPadding_px = 4;

struct AtlasSize {
  int rows = 0, cols = 0;
};

/// One chart per face, in order, at `texels_per_m` or at what `max_megatexels` allows. A chart that
/// is wider than an atlas has fewer texels per metre.
[[nodiscard]] std::vector<Chart> MakeCharts(const BuildingModel& model,
                                            const TextureOptions& options);

/// Places the charts on shelves, highest first; returns the sizes of the atlases.
[[nodiscard]] std::vector<AtlasSize> PackCharts(int atlas_px, std::vector<Chart>& charts);

}  // namespace enfilade
