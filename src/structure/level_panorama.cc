// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/level_panorama.h"

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/resize.h"
#include "enfilade/image/sampling.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Pixels a radian at the centre of the picture.
double AngularResolution(const Camera& camera) {
  return camera.model == CameraModel::kPinhole ? camera.fx : camera.width / (2 * kPi);
}

// The picture reduced by area averaging so that one of its pixels is about one of the result's.
ImageU8 Reduce(const ImageU8& picture, double scale) {
  if (scale >= 0.75) return picture;
  return ReduceImage(picture, std::max(1, static_cast<int>(std::lround(picture.rows() * scale))),
                     std::max(1, static_cast<int>(std::lround(picture.cols() * scale))));
}

ImageU8 ReadMask(const View& view) {
  return view.mask_path.empty() ? ImageU8() : ReadImageGray(view.mask_path);
}

}  // namespace

Eigen::Vector3d LevelPixels::Direction(int row, int col) const {
  const double elevation = kPi * (0.5 - (row + 0.5) / rows);
  const double azimuth = AzimuthOfColumn(col, cols);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

std::pair<int, int> LevelPixels::At(const Eigen::Vector3d& direction) const {
  const double elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0));
  const double azimuth = std::atan2(direction.y(), direction.x());
  return {std::clamp(static_cast<int>((0.5 - elevation / kPi) * rows), 0, rows - 1),
          std::clamp(static_cast<int>((azimuth + kPi) / (2 * kPi) * cols), 0, cols - 1)};
}

double LevelPanorama::RowOfElevation(double elevation_rad) const {
  return rows() * (0.5 - elevation_rad / kPi);
}

int LevelWidth(const View& view, int max_width) {
  const double width = 2 * kPi * AngularResolution(view.camera);
  return std::clamp(2 * static_cast<int>(std::lround(width / 2)), 64, max_width);
}

LevelPanorama MakeLevelPanorama(const View& view, const ImageU8& picture,
                                const Rigid3& frame_from_world, int width,
                                double stand_elevation_rad) {
  const int rows = width / 2;
  const Rigid3 frame_from_cam = frame_from_world * view.world_from_cam;
  const Eigen::Matrix3d cam_from_frame = frame_from_cam.rotation.transpose();
  const ImageU8 reduced = Reduce(picture, width / (2 * kPi) / AngularResolution(view.camera));
  const ImageU8 mask = ReadMask(view);
  const Vector2d reduction(static_cast<double>(reduced.cols()) / view.camera.width,
                           static_cast<double>(reduced.rows()) / view.camera.height);

  LevelPanorama level{frame_from_cam.translation, ImageU8(rows, width, 3), ImageU8(rows, width)};
  std::vector<Vector2d> directions;
  for (int c = 0; c < width; ++c) {
    const double azimuth = AzimuthOfColumn(c, width);
    directions.emplace_back(std::cos(azimuth), std::sin(azimuth));
  }
  for (int r = 0; r < rows; ++r) {
    const double elevation = kPi * (0.5 - (r + 0.5) / rows);
    const double cos_elevation = std::cos(elevation), sin_elevation = std::sin(elevation);
    for (int c = 0; c < width; ++c) {
      const Vector2d& direction = directions[static_cast<size_t>(c)];
      const Vector3d ray(cos_elevation * direction.x(), cos_elevation * direction.y(),
                         sin_elevation);
      const std::optional<Vector2d> pixel = view.camera.PixelFromRay(cam_from_frame * ray);
      if (!pixel) continue;
      const bool is_masked =
          !mask.empty() && mask(std::min(static_cast<int>(pixel->y()), mask.rows() - 1),
                                std::min(static_cast<int>(pixel->x()), mask.cols() - 1)) == 0;
      level.is_seen(r, c) = elevation >= stand_elevation_rad && !is_masked;
      const Vector2d p = pixel->cwiseProduct(reduction);
      for (int channel = 0; channel < 3; ++channel) {
        const float value = view.camera.model == CameraModel::kPinhole
                                ? SampleBilinear(reduced, p.x(), p.y(), channel)
                                : SampleBilinearWrapped(reduced, p.x(), p.y(), channel);
        level.rgb(r, c, channel) = static_cast<uint8_t>(value + 0.5F);
      }
    }
  }
  return level;
}

}  // namespace enfilade
