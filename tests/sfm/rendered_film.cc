// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/sfm/rendered_film.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/film.h"
#include "enfilade/synthetic/render.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Surfaces count as the same when their ranges agree to this share.
constexpr double kSameRange = 0.03;

// Range at a position, none where its four pixels lie on different surfaces.
std::optional<double> RangeAt(const ImageF& range_m, const Vector2d& position_px) {
  const int row = static_cast<int>(std::floor(position_px.y() - 0.5));
  const int col = static_cast<int>(std::floor(position_px.x() - 0.5));
  double low = 1e9, high = 0, sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int r = std::clamp(row + i / 2, 0, range_m.rows() - 1);
    const int c = std::clamp(col + i % 2, 0, range_m.cols() - 1);
    const double fraction = std::abs(r + 0.5 - position_px.y()),
                 across = std::abs(c + 0.5 - position_px.x());
    const double range = range_m(r, c);
    low = std::min(low, range);
    high = std::max(high, range);
    sum += range * std::max(0.0, 1 - fraction) * std::max(0.0, 1 - across);
  }
  if (low <= 0 || high > (1 + kSameRange) * low) return std::nullopt;
  return std::clamp(sum, low, high);
}

}  // namespace

std::optional<Vector2d> RenderedFilm::Follow(int from, int to, const Vector2d& position_px) const {
  const Frame &a = frames[static_cast<size_t>(from)], &b = frames[static_cast<size_t>(to)];
  const std::optional<double> range = RangeAt(a.range_m, position_px);
  if (!range) return std::nullopt;
  const Vector3d in_home = a.home_from_cam * (*range * camera.RayFromPixel(position_px));
  const Vector3d in_b = b.home_from_cam.Inverse() * in_home;
  const std::optional<Vector2d> there = camera.PixelFromRay(in_b);
  if (!there) return std::nullopt;
  const std::optional<double> range_there = RangeAt(b.range_m, *there);
  if (!range_there || std::abs(*range_there / in_b.norm() - 1) > kSameRange) return std::nullopt;
  return there;
}

RenderedFilm RenderFilm(int seed, int num_frames, CameraModel model) {
  RunContext context;
  const Home film =
      FilmWalk(MakeHome({.seed = seed, .preset = HomePreset::kWalk, .furniture = 1}), 30);
  RenderOptions options;
  options.samples_per_pixel = 2;
  options.gather_rays = 32;
  options.bounces = 1;
  options.light_cell_m = 0.1;
  const HomeRenderer renderer(film, options, context);
  RenderedFilm result;
  const bool is_pinhole = model == CameraModel::kPinhole;
  result.camera =
      is_pinhole ? PinholeCamera(540, 360, 496, 496, 270, 180) : EquirectangularCamera(1024, 512);
  const Eigen::Matrix3d pano_from_cam =
      is_pinhole ? Eigen::AngleAxisd(-DegToRad(30), Vector3d::UnitY()).toRotationMatrix()
                 : Eigen::Matrix3d::Identity();
  for (int f = 0; f < num_frames; ++f) {
    RenderedPanorama picture = is_pinhole
                                   ? renderer.RenderView(f, result.camera, pano_from_cam, context)
                                   : renderer.Render(f, {1024, 512}, context);
    const Rigid3 home_from_pano = film.cameras[static_cast<size_t>(f)].home_from_cam;
    result.frames.push_back({std::move(picture.rgb), std::move(picture.range_m),
                             home_from_pano * Rigid3{pano_from_cam, Vector3d::Zero()}});
  }
  return result;
}

ImageU8 TimesGain(const ImageU8& image, double gain) {
  ImageU8 result = image;
  for (uint8_t& value : result.data()) {
    value = static_cast<uint8_t>(std::clamp(std::lround(gain * value), 0L, 255L));
  }
  return result;
}

}  // namespace enfilade
