// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/wall_crops.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kMaxCols = 640, kMaxRows = 220;
constexpr int kGap_px = 6;
constexpr double kMargin_rad = 0.12;
constexpr double kMaxElevation_rad = 1.35;
constexpr uint8_t kRed[3] = {220, 30, 30};

// A window on the sphere about a camera, in the home frame.
struct Window {
  double azimuth = 0;        ///< of the middle
  double half_width = 0;     ///< radians
  double low = 0, high = 0;  ///< elevations
  double rad_per_px = 0;
  int rows = 0, cols = 0;

  [[nodiscard]] double AzimuthAt(int col) const {
    return azimuth + half_width - (col + 0.5) * rad_per_px;  // to the right is clockwise
  }
  [[nodiscard]] double ElevationAt(int row) const { return high - (row + 0.5) * rad_per_px; }
  [[nodiscard]] int RowOf(double elevation) const {
    return static_cast<int>(std::floor((high - elevation) / rad_per_px));
  }
};

double AzimuthOf(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

Window WindowAround(const Vector3d& camera, const Room& room, const Wall& wall) {
  const Vector2d eye = camera.head<2>();
  const double from = AzimuthOf(wall.b - eye), to = AzimuthOf(wall.a - eye);
  // From within the room a wall runs clockwise as seen on the page: b lies to the left of a.
  const double width = std::abs(WrapPi(to - from));
  const double near_m = std::max(0.3, DistanceToSegment(eye, wall.a, wall.b));
  const auto elevation = [&](double z) {
    return std::clamp(std::atan2(z - camera.z(), near_m), -kMaxElevation_rad, kMaxElevation_rad);
  };
  Window window;
  window.azimuth = from + 0.5 * WrapPi(to - from);
  window.half_width = std::min(0.5 * width + kMargin_rad, 3.1);
  window.low = elevation(room.floor_z) - kMargin_rad;
  window.high = elevation(room.ceiling_z) + kMargin_rad;
  window.rad_per_px =
      std::max(2 * window.half_width / kMaxCols, (window.high - window.low) / kMaxRows);
  window.cols = std::max(1, static_cast<int>(2 * window.half_width / window.rad_per_px));
  window.rows = std::max(1, static_cast<int>((window.high - window.low) / window.rad_per_px));
  return window;
}

ImageU8 LookThrough(const Window& window, const View& view, const Rigid3& cam_from_home) {
  const ImageU8 picture = ReadImageRgb(view.path);
  ImageU8 crop(window.rows, window.cols, 3);
  for (int row = 0; row < window.rows; ++row) {
    const double elevation = window.ElevationAt(row);
    for (int col = 0; col < window.cols; ++col) {
      const double azimuth = window.AzimuthAt(col);
      const Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const std::optional<Vector2d> pixel = view.camera.PixelFromRay(cam_from_home.rotation * ray);
      if (!pixel) continue;
      for (int channel = 0; channel < 3; ++channel) {
        const float value = view.camera.model == CameraModel::kEquirectangular
                                ? SampleBilinearWrapped(picture, pixel->x(), pixel->y(), channel)
                                : SampleBilinear(picture, pixel->x(), pixel->y(), channel);
        crop(row, col, channel) = static_cast<uint8_t>(std::lround(value));
      }
    }
  }
  return crop;
}

void Paint(ImageU8& image, int row, int col) {
  if (row < 0 || row >= image.rows() || col < 0 || col >= image.cols()) return;
  for (int channel = 0; channel < 3; ++channel) image(row, col, channel) = kRed[channel];
}

// The wall's edges on floor and ceiling, and its ends.
void DrawOutline(const Window& window, const Vector3d& camera, const Room& room, const Wall& wall,
                 ImageU8& crop) {
  const Vector2d eye = camera.head<2>(), along = (wall.b - wall.a).normalized();
  const Vector2d normal(-along.y(), along.x());
  const double distance = normal.dot(eye - wall.a);
  bool was_on_wall = false;
  for (int col = 0; col < window.cols; ++col) {
    const double azimuth = window.AzimuthAt(col);
    const Vector2d ray(std::cos(azimuth), std::sin(azimuth));
    const double toward = -normal.dot(ray);
    const double range = toward > 1e-6 ? distance / toward : -1;
    const double at = along.dot(eye + range * ray - wall.a);
    const bool is_on_wall = range > 0 && at >= 0 && at <= (wall.b - wall.a).norm();
    if (is_on_wall || was_on_wall) {
      const double safe_range = range > 0 ? range : 1e6;
      const int top = window.RowOf(std::atan2(room.ceiling_z - camera.z(), safe_range));
      const int bottom = window.RowOf(std::atan2(room.floor_z - camera.z(), safe_range));
      if (is_on_wall != was_on_wall)
        for (int row = std::max(top, 0); row <= std::min(bottom, crop.rows() - 1); ++row)
          Paint(crop, row, col);
      Paint(crop, top, col);
      Paint(crop, bottom, col);
    }
    was_on_wall = is_on_wall;
  }
}

ImageU8 Stack(const std::vector<ImageU8>& crops) {
  int rows = 0, cols = 1;
  for (const ImageU8& crop : crops) {
    rows += crop.rows() + (rows > 0 ? kGap_px : 0);
    cols = std::max(cols, crop.cols());
  }
  ImageU8 sheet(std::max(rows, 1), cols, 3, 255);
  int top = 0;
  for (const ImageU8& crop : crops) {
    for (int row = 0; row < crop.rows(); ++row)
      std::copy(crop.row(row), crop.row(row) + 3 * crop.cols(), sheet.row(top + row));
    top += crop.rows() + kGap_px;
  }
  return sheet;
}

}  // namespace

ImageU8 DrawWallCrops(const Scene& scene, const Rigid3& home_from_world, const Room& room,
                      const Wall& wall, std::span<const WallWitness> witnesses, size_t max_crops) {
  std::vector<ImageU8> crops;
  for (const WallWitness& witness : witnesses.first(std::min(max_crops, witnesses.size()))) {
    const View& view = scene.views[static_cast<size_t>(witness.view_idx)];
    const Rigid3 home_from_cam = home_from_world * view.world_from_cam;
    const Window window = WindowAround(home_from_cam.translation, room, wall);
    ImageU8 crop = LookThrough(window, view, home_from_cam.Inverse());
    DrawOutline(window, home_from_cam.translation, room, wall, crop);
    crops.push_back(std::move(crop));
  }
  return Stack(crops);
}

}  // namespace enfilade
