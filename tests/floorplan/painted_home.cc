// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/floorplan/painted_home.h"

#include <limits>

#include "enfilade/image/codec.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 1536, kHeight = 768;
constexpr double kCeiling_m = 2.4;

uint8_t Look(const std::vector<PaintedQuad>& quads, const Vector3d& position, const Vector3d& ray) {
  double nearest = ray.z() < 0 ? -position.z() / ray.z() : (kCeiling_m - position.z()) / ray.z();
  uint8_t gray = ray.z() < 0 ? 120 : 240;
  for (const PaintedQuad& quad : quads) {
    const double t = (quad.offset - position[quad.axis]) / ray[quad.axis];
    // Of two quads in one plane the later is painted over the earlier.
    if (!(t > 0) || t > nearest + 1e-9) continue;
    const Vector3d p = position + t * ray;
    const double along = p[1 - quad.axis];
    if (along < quad.from || along > quad.to || p.z() < quad.low_z || p.z() > quad.high_z) continue;
    nearest = t;
    gray = quad.gray;
  }
  return gray;
}

}  // namespace

std::vector<PaintedQuad> PaintBox(double min_x, double min_y, double max_x, double max_y) {
  std::vector<PaintedQuad> quads;
  for (const auto& [high_z, gray] : {std::pair{kCeiling_m, uint8_t{200}}, {0.08, uint8_t{150}}}) {
    quads.push_back({0, min_x, min_y, max_y, 0, high_z, gray});
    quads.push_back({0, max_x, min_y, max_y, 0, high_z, gray});
    quads.push_back({1, min_y, min_x, max_x, 0, high_z, gray});
    quads.push_back({1, max_y, min_x, max_x, 0, high_z, gray});
  }
  return quads;
}

View PaintView(const std::vector<PaintedQuad>& quads, const Vector3d& position,
               const std::filesystem::path& path) {
  View view;
  view.picture = path.filename().native();
  view.path = path;
  view.camera = EquirectangularCamera(kWidth, kHeight);
  view.world_from_cam.rotation.col(0) = Vector3d::UnitX();
  view.world_from_cam.rotation.col(1) = -Vector3d::UnitZ();
  view.world_from_cam.rotation.col(2) = Vector3d::UnitY();
  view.world_from_cam.translation = position;
  ImageU8 picture(kHeight, kWidth);
  for (int r = 0; r < kHeight; ++r) {
    for (int c = 0; c < kWidth; ++c) {
      const Vector3d ray = view.camera.RayFromPixel({c + 0.5, r + 0.5});
      picture(r, c) = Look(quads, position, view.world_from_cam.rotation * ray);
    }
  }
  WriteImage(path, picture);
  return view;
}

}  // namespace enfilade
