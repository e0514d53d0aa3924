// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/render_chart.h"

#include <algorithm>
#include <cmath>

#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Weights are compared with each other: a stand-in counts only where the chosen view has next to
// none.
constexpr float kStandInWeight = 0.01F;
constexpr int kMaxSupersampling = 4;
// Above the camera's stand a picture fades out over this share of its rows, to below a stand-in.
constexpr double kStandFade = 0.04;
constexpr double kFadedWeight = 1e-12;

// One call of RenderChart.
class ChartRenderer {
 public:
  ChartRenderer(const Chart& chart, const ChartViews& chart_views, const std::vector<int>& chosen,
                size_t label, const TextureView& view, const Vector3d& gain, const Picture& picture,
                const Visibility& visibility, ImageF& rgbw)
      : chart_(chart),
        chart_views_(chart_views),
        label_(label),
        view_(view),
        gain_(gain.cast<float>()),
        picture_(picture),
        visibility_(visibility),
        rgbw_(rgbw) {
    weights_ = TileWeights(chosen);
  }

  void Render() {
    for (int r = 0; r < chart_.tile_rows; ++r) {
      for (int c = 0; c < chart_.tile_cols; ++c) {
        if (TouchesWeight(r, c)) RenderTile(r, c);
      }
    }
  }

 private:
  [[nodiscard]] size_t Tile(int row, int col) const {
    return static_cast<size_t>(row * chart_.tile_cols + col);
  }

  [[nodiscard]] bool IsFullySeenBy(size_t label, size_t tile) const {
    return chart_views_.views[label].tiles[tile].seen == chart_views_.inside[tile];
  }

  [[nodiscard]] std::vector<float> TileWeights(const std::vector<int>& chosen) const {
    std::vector<float> weights(chosen.size(), 0.0F);
    for (size_t tile = 0; tile < chosen.size(); ++tile) {
      if (chosen[tile] < 0) continue;
      const auto best = static_cast<size_t>(chosen[tile]);
      if (best == label_) {
        weights[tile] = 1;
      } else if (chart_views_.views[label_].tiles[tile].seen != 0 && NeedsStandIn(tile, chosen)) {
        weights[tile] = kStandInWeight;
      }
    }
    return weights;
  }

  // In and beside tiles that their chosen view does not see as a whole.
  [[nodiscard]] bool NeedsStandIn(size_t tile, const std::vector<int>& chosen) const {
    const int index = static_cast<int>(tile);
    return AnyOfBlock(index / chart_.tile_cols, index % chart_.tile_cols, [&](size_t near) {
      return chosen[near] >= 0 && !IsFullySeenBy(static_cast<size_t>(chosen[near]), near);
    });
  }

  // Calls visit on the tiles of the 3 × 3 block that exist; true when it is true for any.
  template <typename Visit>
  [[nodiscard]] bool AnyOfBlock(int row, int col, const Visit& visit) const {
    for (int r = std::max(0, row - 1); r <= std::min(chart_.tile_rows - 1, row + 1); ++r) {
      for (int c = std::max(0, col - 1); c <= std::min(chart_.tile_cols - 1, col + 1); ++c) {
        if (visit(Tile(r, c))) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool TouchesWeight(int row, int col) const {
    return AnyOfBlock(row, col, [&](size_t tile) { return weights_[tile] > 0; });
  }

  // Bilinear between the tiles' centres and steepened, so that little of the fade shows two
  // pictures.
  [[nodiscard]] float WeightAt(double x, double y) const {
    const double u = std::clamp(x / chart_.tile_px - 0.5, 0.0, chart_.tile_cols - 1.0);
    const double v = std::clamp(y / chart_.tile_px - 0.5, 0.0, chart_.tile_rows - 1.0);
    const int c0 = static_cast<int>(u), r0 = static_cast<int>(v);
    const int c1 = std::min(c0 + 1, chart_.tile_cols - 1),
              r1 = std::min(r0 + 1, chart_.tile_rows - 1);
    const auto a = static_cast<float>(u - c0), b = static_cast<float>(v - r0);
    const float weight = (1 - b) * ((1 - a) * weights_[Tile(r0, c0)] + a * weights_[Tile(r0, c1)]) +
                         b * ((1 - a) * weights_[Tile(r1, c0)] + a * weights_[Tile(r1, c1)]);
    return weight * weight * weight;
  }

  // From 1 down to next to nothing towards the stand.
  [[nodiscard]] float StandFade(const Vector2d& pixel) const {
    if (view_.camera.model != CameraModel::kEquirectangular) return 1;
    const double left = (view_.last_row - pixel.y()) / (kStandFade * view_.camera.height);
    return left >= 1 ? 1.0F : static_cast<float>(std::pow(kFadedWeight, 1 - std::max(left, 0.0)));
  }

  void RenderTile(int tile_row, int tile_col) {
    // Inside a region that is seen as a whole no texel needs a ray of its own.
    const bool needs_rays =
        AnyOfBlock(tile_row, tile_col, [&](size_t tile) { return !IsFullySeenBy(label_, tile); });
    const int r1 = std::min((tile_row + 1) * chart_.tile_px, chart_.rows);
    const int c1 = std::min((tile_col + 1) * chart_.tile_px, chart_.cols);
    for (int r = tile_row * chart_.tile_px; r < r1; ++r) {
      for (int c = tile_col * chart_.tile_px; c < c1; ++c) {
        if (chart_.is_inside(r, c) == 0) continue;
        const float weight = WeightAt(c + 0.5, r + 0.5);
        if (weight > 0) RenderTexel(r, c, weight, needs_rays);
      }
    }
  }

  void RenderTexel(int row, int col, float weight, bool needs_ray) {
    const Vector3d point = chart_.PointAt(col + 0.5, row + 0.5);
    if (needs_ray && !visibility_.IsSeen(view_.position, point)) return;
    // As many samples a side as the picture has pixels for the texel where it is seen frontally.
    const double pixels =
        view_.pixels_per_rad / ((point - view_.position).norm() * chart_.texels_per_m);
    const int n = std::clamp(static_cast<int>(std::ceil(pixels - 0.25)), 1, kMaxSupersampling);
    Vector3f sum(0, 0, 0);
    int num_samples = 0;
    float fade = 1;
    for (int i = 0; i < n * n; ++i) {
      const auto pixel =
          view_.PixelOf(chart_.PointAt(col + (i % n + 0.5) / n, row + (i / n + 0.5) / n));
      if (!pixel || IsMasked(*pixel)) continue;
      sum += ColourAt(*pixel);
      fade = std::min(fade, StandFade(*pixel));
      ++num_samples;
    }
    if (num_samples == 0) return;
    const Vector3f colour = gain_.cwiseProduct(sum) / static_cast<float>(num_samples);
    for (int k = 0; k < 3; ++k) rgbw_(row, col, k) += fade * weight * colour[k];
    rgbw_(row, col, 3) += fade * weight;
  }

  [[nodiscard]] bool IsMasked(const Vector2d& pixel) const {
    if (picture_.mask.empty()) return false;
    const int row = std::min(static_cast<int>(pixel.y()), picture_.mask.rows() - 1);
    const int col = std::min(static_cast<int>(pixel.x()), picture_.mask.cols() - 1);
    return picture_.mask(row, col) == 0;
  }

  [[nodiscard]] Vector3f ColourAt(const Vector2d& pixel) const {
    Vector3f colour;
    const bool wraps = view_.camera.model == CameraModel::kEquirectangular;
    for (int k = 0; k < 3; ++k) {
      colour[k] = wraps ? SampleBilinearWrapped(picture_.rgb, pixel.x(), pixel.y(), k)
                        : SampleBilinear(picture_.rgb, pixel.x(), pixel.y(), k);
    }
    return colour;
  }

  const Chart& chart_;
  const ChartViews& chart_views_;
  size_t label_;
  const TextureView& view_;
  Vector3f gain_;
  const Picture& picture_;
  const Visibility& visibility_;
  ImageF& rgbw_;
  std::vector<float> weights_;
};

}  // namespace

void RenderChart(const Chart& chart, const ChartViews& chart_views, const std::vector<int>& chosen,
                 size_t label, const TextureView& view, const Vector3d& gain,
                 const Picture& picture, const Visibility& visibility, ImageF& rgbw) {
  ChartRenderer(chart, chart_views, chosen, label, view, gain, picture, visibility, rgbw).Render();
}

}  // namespace enfilade
