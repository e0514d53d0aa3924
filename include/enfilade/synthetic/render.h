// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/exchange/pixel_truth.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

struct RenderOptions {
  int samples_per_pixel = 4;
  int gather_rays = 144;
  int bounces = 3;
  double light_cell_m = 0.05;
  double blur_px = 0.6;
  double noise = 1.2;
  double stand_share = 0.07;

  void Visit(OptionVisitor& v) {
    v("samples_per_pixel", samples_per_pixel, "Rays per pixel, against jagged edges.", {1, 64});
    v("gather_rays", gather_rays, "Rays per point and bounce that collect indirect light.",
      {8, 4096});
    v("bounces", bounces, "Times that light is reflected before it is lost.", {0, 8});
    v("light_cell_m", light_cell_m,
      "Spacing of the points on surfaces at which the light is worked out.", {0.01, 1.0});
    v("blur_px", blur_px, "Standard deviation of the lens' blur, in pixels.", {0.0, 10.0});
    v("noise", noise, "Standard deviation of the sensor's noise, in grey levels of 255.",
      {0.0, 20.0});
    v("stand_share", stand_share, "Share of the rows, at the bottom, that show the camera's stand.",
      {0.0, 0.2});
  }
};

/// A picture and the truth about each pixel's centre. Where the camera's stand or the sky shows,
/// range is 0, the normal zero, the label kOther and the ids −1.
struct RenderedPanorama {
  ImageU8 rgb;             ///< rows × cols × 3, sRGB
  ImageF range_m;          ///< distance from the camera along the ray
  ImageF normal;           ///< × 3, unit, in the world frame, towards the camera
  ImageU8 label;           ///< a SurfaceLabel
  Image<int16_t> room_id;  ///< of the surface; furniture belongs to its room
  Image<int16_t> wall_id;  ///< as in HomeWalls; −1 on everything that is no wall
};

struct LitStorey;  // surfaces, tree and light: private to the renderer

/// Renders pictures of a home: light is worked out once, then reused by every picture. A camera
/// sees its own storey only, and no light comes from another.
///
/// Lamps and the sky in the windows light the surfaces directly with soft shadows; the reflected
/// light is collected over the hemisphere on a coarse grid per surface, bounce by bounce (final
/// gathering of diffuse interreflection after Ward, Rubinstein and Clear 1988, on a regular grid).
/// Glossy floors mirror, and so do panes of glass a little. Exposure follows the walls of the
/// camera's room, and in part those of the whole home. The same home,
/// options and size give the same bytes for any number of threads.
class HomeRenderer {
 public:
  /// Builds the scene and bakes the light: about 7 s of one core for a flat. `home` is copied.
  /// Throws InvalidInputError for options out of range, DependencyError when Embree fails.
  HomeRenderer(const Home& home, const RenderOptions& options, RunContext& context);
  ~HomeRenderer();
  HomeRenderer(const HomeRenderer&) = delete;
  HomeRenderer& operator=(const HomeRenderer&) = delete;

  /// The panorama of home.cameras[camera_idx], equirectangular (scene/camera.h); size.width must be
  /// twice size.height.
  [[nodiscard]] RenderedPanorama Render(int camera_idx, ImageSize size, RunContext& context) const;

  /// What the pinhole camera `view` sees from there, turned as in scene/virtual_view.h, without the
  /// stand. `range_m` is along the ray. Views that differ in `pano_from_view` differ in their
  /// sensor's noise.
  [[nodiscard]] RenderedPanorama RenderView(int camera_idx, const Camera& view,
                                            const Eigen::Matrix3d& pano_from_view,
                                            RunContext& context) const;

 private:
  RenderedPanorama RenderPicture(int camera_idx, const Camera& camera,
                                 const Eigen::Matrix3d& pano_from_cam, uint64_t seed,
                                 RunContext& context) const;

  [[nodiscard]] const Home& home() const;

  std::vector<std::unique_ptr<const LitStorey>> storeys_;
};

}  // namespace enfilade
