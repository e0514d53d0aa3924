// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/model/visibility.h"
#include "src/model/chart.h"
#include "src/model/tile_views.h"

namespace enfilade {

/// A decoded picture with its mask (may be empty: all counts).
struct Picture {
  ImageU8 rgb;
  ImageU8 mask;
};

/// Adds what the view with index `label` in `chart_views.views` shows to `rgbw` (chart.rows ×
/// chart.cols × 4: weighted colour sums and weights). A texel's weight fades from tile to tile;
/// hidden texels get none. In tiles that the chosen view sees only in part, the others stand in
/// with a weight that counts only where the chosen one is hidden.
void RenderChart(const Chart& chart, const ChartViews& chart_views, const std::vector<int>& chosen,
                 size_t label, const TextureView& view, const Eigen::Vector3d& gain,
                 const Picture& picture, const Visibility& visibility, ImageF& rgbw);

}  // namespace enfilade
