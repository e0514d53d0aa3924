// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/surface.h"

#include <algorithm>
#include <cmath>

#include "src/synthetic/random.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

void AddFurniture(const Home& home, SurfaceList& list) {
  for (const HomeBox& box : home.boxes) {
    SurfaceTraits traits;
    traits.finish = box.finish;
    traits.rgb = box.rgb;
    traits.room_id = box.room_id;
    list.AddBox(box, traits);
  }
}

}  // namespace

void SurfaceList::Add(Surface surface) {
  surface.seed = PartSeed(seed_, surfaces_.size());
  surfaces_.push_back(std::move(surface));
}

void SurfaceList::AddRectangle(const Vector3d& origin, const Vector3d& u, const Vector3d& v,
                               const Vector3d& normal, const SurfaceTraits& traits) {
  Surface surface;
  surface.origin = origin.cast<float>();
  surface.axis_u = u.normalized().cast<float>();
  surface.axis_v = v.normalized().cast<float>();
  surface.normal = normal.normalized().cast<float>();
  const auto width = static_cast<float>(u.norm()), height = static_cast<float>(v.norm());
  surface.extent = {width, height};
  surface.vertices = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  surface.finish = traits.finish;
  surface.rgb = traits.rgb;
  surface.gloss = traits.gloss;
  surface.label = traits.label;
  surface.room_id = traits.room_id;
  surface.wall_id = traits.wall_id;
  Add(std::move(surface));
}

void SurfaceList::AddBox(const HomeBox& box, const SurfaceTraits& traits) {
  const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
  const Vector3d x = box.size.x() * Vector3d(c, s, 0), y = box.size.y() * Vector3d(-s, c, 0);
  const Vector3d z(0, 0, box.z1 - box.z0);
  const Vector3d low = Vector3d(box.center.x(), box.center.y(), box.z0) - 0.5 * (x + y);
  // The first axis is the longer one of the front, so that grain runs along boards.
  AddRectangle(low, x, z, -y, traits);
  AddRectangle(low + y, x, z, y, traits);
  AddRectangle(low, y, z, -x, traits);
  AddRectangle(low + x, y, z, x, traits);
  AddRectangle(low + z, x, y, z, traits);
  AddRectangle(low, x, y, -z, traits);
}

std::vector<Surface> MakeSurfaces(const Home& home) {
  SurfaceList list(home.seed);
  AddShell(home, list);
  AddTrim(home, list);
  AddFurniture(home, list);
  return list.Take();
}

std::vector<Surface> MakeSurfaces(const Home& home, int storey_idx) {
  std::vector<Surface> surfaces = MakeSurfaces(home);
  std::erase_if(surfaces, [&](const Surface& surface) {
    return !home.IsOnStorey(surface.room_id, storey_idx);
  });
  return surfaces;
}

}  // namespace enfilade
