// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ply_writer.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "enfilade/base/check.h"
#include "enfilade/base/file.h"
#include "src/exchange/little_endian.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using Colour = Eigen::Matrix<uint8_t, 3, 1>;

constexpr char kPosition[] = "property float x\nproperty float y\nproperty float z\n";
constexpr char kNormal[] = "property float nx\nproperty float ny\nproperty float nz\n";
constexpr char kColour[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

std::string Head(size_t num_vertices) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, z up\nelement vertex {}\n",
      num_vertices);
}

void AppendFloats(const Vector3d& values, std::string& bytes) {
  for (const double value : values) AppendLittleEndian(static_cast<float>(value), bytes);
}

void AppendColour(const Colour& colour, std::string& bytes) {
  for (const uint8_t channel : colour) AppendLittleEndian(channel, bytes);
}

// In the camera's frame (x right, y down, z forward), for a pyramid of length 1: tip, base, upper
// tip.
const std::array<Vector3d, 6> kMarkerVertices{Vector3d(0, 0, 0),       Vector3d(-0.75, -0.5, 1),
                                              Vector3d(0.75, -0.5, 1), Vector3d(0.75, 0.5, 1),
                                              Vector3d(-0.75, 0.5, 1), Vector3d(0, -0.9, 1)};
// Counter-clockwise seen from outside: sides, base, the triangle above.
constexpr std::array<std::array<int, 3>, 7> kMarkerTriangles{
    {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {1, 5, 2}}};

}  // namespace

void WritePointsPly(const std::filesystem::path& path, std::span<const ScenePoint> points) {
  const bool has_normals = std::any_of(points.begin(), points.end(), [](const ScenePoint& point) {
    return !point.normal.isZero(0);
  });
  std::string bytes =
      Head(points.size()) + kPosition + (has_normals ? kNormal : "") + kColour + "end_header\n";
  for (const ScenePoint& point : points) {
    AppendFloats(point.position, bytes);
    if (has_normals) AppendFloats(point.normal, bytes);
    AppendColour(point.rgb, bytes);
  }
  WriteFileAtomic(path, bytes);
}

void WriteCamerasPly(const std::filesystem::path& path, std::span<const View> views,
                     double length_m) {
  ENFILADE_CHECK(length_m > 0);
  const Colour tip(255, 255, 255), panorama(50, 110, 220), photo(240, 140, 30);
  std::string bytes = Head(kMarkerVertices.size() * views.size()) + kPosition + kColour +
                      fmt::format("element face {}\nproperty list uchar int vertex_indices\n",
                                  kMarkerTriangles.size() * views.size()) +
                      "end_header\n";
  for (const View& view : views) {
    const bool is_panorama = view.camera.model == CameraModel::kEquirectangular;
    for (size_t k = 0; k < kMarkerVertices.size(); ++k) {
      AppendFloats(view.world_from_cam * Vector3d(length_m * kMarkerVertices[k]), bytes);
      AppendColour(k == 0 ? tip : is_panorama ? panorama : photo, bytes);
    }
  }
  for (size_t i = 0; i < views.size(); ++i) {
    for (const std::array<int, 3>& triangle : kMarkerTriangles) {
      AppendLittleEndian(static_cast<uint8_t>(triangle.size()), bytes);
      for (const int corner : triangle) {
        AppendLittleEndian(static_cast<int32_t>(i * kMarkerVertices.size()) + corner, bytes);
      }
    }
  }
  WriteFileAtomic(path, bytes);
}

}  // namespace enfilade
