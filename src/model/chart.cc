// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Bounding rectangle of the face on its plane. «Up» is z for walls, +y for floors, −y for ceilings,
// so that right × up is the normal and nothing is mirrored.
Chart ChartOfFace(const ModelFace& face) {
  Chart chart;
  const bool is_wall = face.kind == SurfaceKind::kWall;
  const Vector3d up = is_wall ? Vector3d::UnitZ() : Vector3d(0, face.normal.z() > 0 ? 1 : -1, 0);
  chart.right = up.cross(face.normal).normalized();
  chart.down = -up;
  Eigen::AlignedBox2d bounds;
  for (const Vector3d& p : face.vertices) {
    bounds.extend(Vector2d(chart.right.dot(p), chart.down.dot(p)));
  }
  chart.width_m = bounds.sizes().x();
  chart.height_m = bounds.sizes().y();
  chart.origin = bounds.min().x() * chart.right + bounds.min().y() * chart.down +
                 face.normal.dot(face.vertices[0]) * face.normal;
  return chart;
}

void SetResolution(double texels_per_m, const TextureOptions& options, Chart& chart) {
  const double longest_m = std::max(chart.width_m, chart.height_m);
  const double room_px = options.atlas_px - 2 * kChartPadding_px;
  chart.texels_per_m = std::min(texels_per_m, (room_px - 1) / longest_m);
  const auto num_texels = [&](double length_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m * chart.texels_per_m - 1e-9)));
  };
  chart.rows = num_texels(chart.height_m);
  chart.cols = num_texels(chart.width_m);
  chart.tile_px = std::max(1, static_cast<int>(std::lround(options.tile_m * chart.texels_per_m)));
  chart.tile_rows = (chart.rows + chart.tile_px - 1) / chart.tile_px;
  chart.tile_cols = (chart.cols + chart.tile_px - 1) / chart.tile_px;
}

double CrossZ(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Marks the texels whose centre lies in the triangle or within half a texel of it.
void MarkTriangle(std::array<Vector2d, 3> t, ImageU8& mask) {
  if (CrossZ(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
  const auto [min_x, max_x] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
  const auto [min_y, max_y] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
  const int r0 = std::max(0, static_cast<int>(min_y - 1));
  const int r1 = std::min(mask.rows() - 1, static_cast<int>(max_y + 1));
  const int c0 = std::max(0, static_cast<int>(min_x - 1));
  const int c1 = std::min(mask.cols() - 1, static_cast<int>(max_x + 1));
  for (int r = r0; r <= r1; ++r) {
    for (int c = c0; c <= c1; ++c) {
      const Vector2d p(c + 0.5, r + 0.5);
      bool is_inside = true;
      for (int i = 0; i < 3 && is_inside; ++i) {
        const Vector2d edge = t[(i + 1) % 3] - t[i];
        is_inside = CrossZ(edge, p - t[i]) >= -0.5 * edge.norm();
      }
      if (is_inside) mask(r, c) = 1;
    }
  }
}

void MarkInside(const ModelFace& face, Chart& chart) {
  const bool is_wall = face.kind == SurfaceKind::kWall;
  chart.is_inside = ImageU8(chart.rows, chart.cols, 1, is_wall ? 1 : 0);
  if (is_wall) return;
  for (const std::array<int, 3>& triangle : face.triangles) {
    std::array<Vector2d, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = chart.TexelOf(face.vertices[static_cast<size_t>(triangle[i])]);
    }
    MarkTriangle(corners, chart.is_inside);
  }
}

}  // namespace

Vector3d Chart::PointAt(double x, double y) const {
  return origin + std::clamp(x / texels_per_m, 0.0, width_m) * right +
         std::clamp(y / texels_per_m, 0.0, height_m) * down;
}

Vector2d Chart::TexelOf(const Vector3d& point) const {
  const Vector3d offset = point - origin;
  return texels_per_m * Vector2d(right.dot(offset), down.dot(offset));
}

std::vector<Chart> MakeCharts(const BuildingModel& model, const TextureOptions& options) {
  std::vector<Chart> charts;
  double area_m2 = 0;
  for (const ModelFace& face : model.faces) {
    charts.push_back(ChartOfFace(face));
    area_m2 += charts.back().width_m * charts.back().height_m;
  }
  const double texels_per_m =
      area_m2 > 0
          ? std::min(options.texels_per_m, std::sqrt(1e6 * options.max_megatexels / area_m2))
          : options.texels_per_m;
  for (size_t f = 0; f < charts.size(); ++f) {
    SetResolution(texels_per_m, options, charts[f]);
    MarkInside(model.faces[f], charts[f]);
  }
  return charts;
}

std::vector<AtlasSize> PackCharts(int atlas_px, std::vector<Chart>& charts) {
  std::vector<size_t> order(charts.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return charts[a].rows > charts[b].rows; });
  std::vector<AtlasSize> atlases;
  int shelf_row = 0, shelf_height = 0, next_col = 0;
  for (const size_t i : order) {
    Chart& chart = charts[i];
    const int height = chart.rows + 2 * kChartPadding_px, width = chart.cols + 2 * kChartPadding_px;
    ENFILADE_CHECK(height <= atlas_px && width <= atlas_px);
    if (atlases.empty() || next_col + width > atlas_px) {  // a new shelf
      shelf_row += shelf_height;
      shelf_height = height;
      next_col = 0;
      if (atlases.empty() || shelf_row + height > atlas_px) {  // on a new atlas
        atlases.push_back({0, 0});
        shelf_row = 0;
      }
    }
    chart.atlas_idx = static_cast<int>(atlases.size()) - 1;
    chart.atlas_row = shelf_row + kChartPadding_px;
    chart.atlas_col = next_col + kChartPadding_px;
    next_col += width;
    atlases.back().rows = std::max(atlases.back().rows, shelf_row + height);
    atlases.back().cols = std::max(atlases.back().cols, next_col);
  }
  return atlases;
}

}  // namespace enfilade
