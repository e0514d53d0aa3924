// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/tile_views.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A camera nearer to a face's plane than this sees nothing of use on it.
constexpr double kMinPlaneDistance_m = 0.05;
constexpr double kMinCosine = 0.03;

// Log of pixels per square metre of the face, with one more cosine: errors of pose and wall show as
// shifts that grow with the slant.
float LogQuality(const TextureView& view, const Vector3d& point, const Vector3d& normal) {
  const Vector3d to_camera = view.position - point;
  const double squared_distance = to_camera.squaredNorm();
  const double cosine = std::max(kMinCosine, normal.dot(to_camera) / std::sqrt(squared_distance));
  const double resolution = view.pixels_per_rad * view.pixels_per_rad / squared_distance;
  return static_cast<float>(std::log(resolution * cosine * cosine));
}

std::vector<uint16_t> FindInside(const Chart& chart) {
  std::vector<uint16_t> inside;
  for (int r = 0; r < chart.tile_rows; ++r) {
    for (int c = 0; c < chart.tile_cols; ++c) {
      uint16_t bits = 0;
      for (int s = 0; s < kTileSamples * kTileSamples; ++s) {
        const Vector2d texel = SampleTexel(chart, r, c, s);
        const int row = std::min(static_cast<int>(texel.y()), chart.rows - 1);
        const int col = std::min(static_cast<int>(texel.x()), chart.cols - 1);
        if (chart.is_inside(row, col) != 0) bits = static_cast<uint16_t>(bits | 1 << s);
      }
      inside.push_back(bits);
    }
  }
  return inside;
}

// Calls visit(tile, sample, point) for every sample whose bit is set in bits_of(tile).
template <typename BitsOf, typename Visit>
void ForEachSample(const Chart& chart, const BitsOf& bits_of, const Visit& visit) {
  for (int tile = 0; tile < chart.tile_rows * chart.tile_cols; ++tile) {
    const int bits = bits_of(static_cast<size_t>(tile));
    for (int s = 0; bits != 0 && s < kTileSamples * kTileSamples; ++s) {
      if ((bits >> s & 1) == 0) continue;
      const Vector2d texel = SampleTexel(chart, tile / chart.tile_cols, tile % chart.tile_cols, s);
      visit(static_cast<size_t>(tile), s, chart.PointAt(texel.x(), texel.y()));
    }
  }
}

}  // namespace

std::optional<Vector2d> TextureView::PixelOf(const Vector3d& in_home) const {
  const auto pixel = camera.PixelFromRay(cam_from_home * (in_home - position));
  return pixel && pixel->y() < last_row ? pixel : std::nullopt;
}

TextureView MakeTextureView(const View& view, const Rigid3& home_from_world, double stand_row) {
  const Rigid3 home_from_cam = home_from_world * view.world_from_cam;
  const bool is_sphere = view.camera.model == CameraModel::kEquirectangular;
  return {view.camera, home_from_cam.rotation.transpose(), home_from_cam.translation,
          is_sphere ? view.camera.width / (2 * kPi) : view.camera.fx,
          is_sphere ? stand_row * view.camera.height : view.camera.height};
}

Vector2d SampleTexel(const Chart& chart, int tile_row, int tile_col, int sample) {
  const double x = tile_col + (sample % kTileSamples + 0.5) / kTileSamples;
  const double y = tile_row + (sample / kTileSamples + 0.5) / kTileSamples;
  return {std::min(x * chart.tile_px, chart.cols - 0.5),
          std::min(y * chart.tile_px, chart.rows - 0.5)};
}

ChartViews FindChartViews(const Chart& chart, const ModelFace& face, const Scene& scene,
                          const std::vector<TextureView>& views, const Visibility& visibility) {
  ChartViews found{FindInside(chart), {}};
  for (size_t v = 0; v < views.size(); ++v) {
    const TextureView& view = views[v];
    if (scene.views[v].storey_idx != face.storey_idx ||
        face.normal.dot(view.position - face.vertices[0]) < kMinPlaneDistance_m) {
      continue;
    }
    ChartView seen{static_cast<int>(v), std::vector<TileView>(found.inside.size())};
    bool sees_any = false;
    ForEachSample(
        chart, [&](size_t tile) { return found.inside[tile]; },
        [&](size_t tile, int sample, const Vector3d& point) {
          if (!view.PixelOf(point) || !visibility.IsSeen(view.position, point)) return;
          TileView& tile_view = seen.tiles[tile];
          tile_view.seen = static_cast<uint16_t>(tile_view.seen | 1 << sample);
          tile_view.log_quality = LogQuality(view, point, face.normal);
          sees_any = true;
        });
    if (sees_any) found.views.push_back(std::move(seen));
  }
  return found;
}

void SampleTileColours(const ImageU8& picture, const ImageU8& mask, int view_idx,
                       const TextureView& view, const std::vector<Chart>& charts,
                       std::vector<ChartViews>& chart_views) {
  for (size_t i = 0; i < charts.size(); ++i) {
    for (ChartView& chart_view : chart_views[i].views) {
      if (chart_view.view_idx != view_idx) continue;
      ForEachSample(
          charts[i], [&](size_t tile) { return chart_view.tiles[tile].seen; },
          [&](size_t tile, int sample, const Vector3d& point) {
            TileView& tile_view = chart_view.tiles[tile];
            const Vector2d pixel = view.PixelOf(point).value();
            const int row = std::min(static_cast<int>(pixel.y()), view.camera.height - 1);
            const int col = std::min(static_cast<int>(pixel.x()), view.camera.width - 1);
            if (!mask.empty() && mask(row, col) == 0) {
              tile_view.seen = static_cast<uint16_t>(tile_view.seen & ~(1 << sample));
              return;
            }
            for (int k = 0; k < 3; ++k) tile_view.rgb[k] += picture(row, col, k);
          });
      for (TileView& tile_view : chart_view.tiles) {
        const int num_seen = std::popcount(tile_view.seen);
        if (num_seen > 0) tile_view.rgb /= static_cast<float>(num_seen);
      }
    }
  }
}

}  // namespace enfilade
