// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/synthetic/render.h"
#include "src/synthetic/ray_scene.h"
#include "src/synthetic/surface.h"

namespace enfilade {

/// Irradiance on a regular grid over a surface's extent.
struct LightGrid {
  int cols = 1, rows = 1;
  Eigen::Vector2f cell{1, 1};               ///< metres
  std::vector<Eigen::Vector3f> irradiance;  ///< row by row

  [[nodiscard]] Eigen::Vector2f Center(int row, int col) const {
    return {(static_cast<float>(col) + 0.5f) * cell.x(),
            (static_cast<float>(row) + 0.5f) * cell.y()};
  }
  [[nodiscard]] size_t Index(int row, int col) const {
    return static_cast<size_t>(row) * static_cast<size_t>(cols) + static_cast<size_t>(col);
  }
  [[nodiscard]] Eigen::Vector3f& At(int row, int col) { return irradiance[Index(row, col)]; }
  [[nodiscard]] const Eigen::Vector3f& At(int row, int col) const {
    return irradiance[Index(row, col)];
  }
  /// Bilinear, clamped at the border.
  [[nodiscard]] Eigen::Vector3f Sample(float u, float v) const {
    const float x = std::clamp(u / cell.x() - 0.5f, 0.0f, static_cast<float>(cols - 1));
    const float y = std::clamp(v / cell.y() - 0.5f, 0.0f, static_cast<float>(rows - 1));
    const int c0 = static_cast<int>(x), r0 = static_cast<int>(y);
    const int c1 = std::min(c0 + 1, cols - 1), r1 = std::min(r0 + 1, rows - 1);
    const float a = x - static_cast<float>(c0), b = y - static_cast<float>(r0);
    return (1 - b) * ((1 - a) * At(r0, c0) + a * At(r0, c1)) +
           b * ((1 - a) * At(r1, c0) + a * At(r1, c1));
  }
};

/// A grid over [0, extent] with cells of at most `max_cell_m`, all zero.
[[nodiscard]] LightGrid MakeLightGrid(const Eigen::Vector2f& extent, float max_cell_m);

/// The light on every surface: straight from lamps and windows on a fine grid, reflected on a
/// coarse one. The sun's own is not among it: grids would blur the edges of its patches.
struct BakedLight {
  std::vector<LightGrid> direct, reflected;  ///< one a surface

  [[nodiscard]] Eigen::Vector3f IrradianceAt(const RayHit& hit) const {
    const auto i = static_cast<size_t>(hit.surface_idx);
    return direct[i].Sample(hit.u, hit.v) + reflected[i].Sample(hit.u, hit.v);
  }
};

/// What the sun adds at a point on a surface with that normal: all or nothing, at the sharpness of
/// the asking.
[[nodiscard]] Eigen::Vector3f SunIrradiance(const Home& home, const RayScene& scene,
                                            const Eigen::Vector3f& point,
                                            const Eigen::Vector3f& normal);

/// Works out the light: direct by sampling lamps and windows with shadow rays, then
/// `options.bounces` times the hemisphere above every coarse cell, sunlit places included.
/// Deterministic for any number of threads.
[[nodiscard]] BakedLight BakeLight(const Home& home, const std::vector<Surface>& surfaces,
                                   const RayScene& scene, const RenderOptions& options,
                                   RunContext& context);

}  // namespace enfilade
