// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "enfilade/geometry/triangulate.h"
#include "src/synthetic/random.h"
#include "src/synthetic/surface.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::array<float, 3> kCeilingWhite = {0.82f, 0.82f, 0.80f};

Vector3d At(const Vector2d& p, double z) { return {p.x(), p.y(), z}; }

void AddLevel(const HomeRoom& room, bool is_floor, SurfaceList& list) {
  const Triangulation2 triangulation = Triangulate(room.polygon);
  Vector2d low = triangulation.vertices[0], high = low;
  for (const Vector2d& p : triangulation.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Surface surface;
  surface.origin = At(low, is_floor ? room.floor_z : room.ceiling_z).cast<float>();
  surface.axis_u = Vector3f::UnitX();
  surface.axis_v = Vector3f::UnitY();
  surface.normal = is_floor ? Vector3f(0, 0, 1) : Vector3f(0, 0, -1);
  surface.extent = (high - low).cast<float>();
  for (const Vector2d& p : triangulation.vertices)
    surface.vertices.push_back((p - low).cast<float>());
  surface.triangles = triangulation.triangles;
  surface.finish = is_floor ? room.floor_finish : Finish::kPaint;
  surface.rgb = is_floor ? room.floor_rgb : Vector3f(kCeilingWhite.data());
  surface.gloss = !is_floor || room.floor_finish == Finish::kCarpet ? 0.0f : 0.5f;
  surface.label = is_floor ? SurfaceLabel::kFloor : SurfaceLabel::kCeiling;
  surface.room_id = room.id;
  list.Add(std::move(surface));
}

struct Hole {
  double begin_m, end_m, sill_z, head_z;
};

std::vector<Hole> HolesIn(const Home& home, const HomeWall& wall) {
  std::vector<Hole> holes;
  for (const HomeOpening& opening : home.openings) {
    const auto on = OpeningOnWall(opening, wall);
    if (on) holes.push_back({on->first, on->second, opening.sill_z, opening.head_z});
  }
  std::sort(holes.begin(), holes.end(),
            [](const Hole& a, const Hole& b) { return a.begin_m < b.begin_m; });
  return holes;
}

// Adds [u0, u1] × [z0, z1] to a wall whose vertices count z from `floor_z`.
void AddPanel(Surface& surface, double u0, double u1, double z0, double z1, double floor_z) {
  if (u1 - u0 < 1e-9 || z1 - z0 < 1e-9) return;
  const int first = static_cast<int>(surface.vertices.size());
  for (const Vector2d& p :
       {Vector2d(u0, z0), Vector2d(u1, z0), Vector2d(u1, z1), Vector2d(u0, z1)}) {
    surface.vertices.push_back(Vector2d(p.x(), p.y() - floor_z).cast<float>());
  }
  surface.triangles.push_back({first, first + 1, first + 2});
  surface.triangles.push_back({first, first + 2, first + 3});
}

void AddWall(const Home& home, const HomeWall& wall, SurfaceList& list) {
  const HomeRoom& room = home.RoomById(wall.room_id);
  Surface surface;
  surface.origin = At(wall.a, room.floor_z).cast<float>();
  surface.axis_u = At(wall.Along(), 0).cast<float>();
  surface.axis_v = Vector3f::UnitZ();
  surface.normal = At(wall.Inward(), 0).cast<float>();
  const double length_m = (wall.b - wall.a).norm();
  surface.extent = Vector2d(length_m, room.ceiling_z - room.floor_z).cast<float>();
  double begin_m = 0;
  for (const Hole& hole : HolesIn(home, wall)) {
    AddPanel(surface, begin_m, hole.begin_m, room.floor_z, room.ceiling_z, room.floor_z);
    AddPanel(surface, hole.begin_m, hole.end_m, room.floor_z, hole.sill_z, room.floor_z);
    AddPanel(surface, hole.begin_m, hole.end_m, hole.head_z, room.ceiling_z, room.floor_z);
    begin_m = hole.end_m;
  }
  AddPanel(surface, begin_m, length_m, room.floor_z, room.ceiling_z, room.floor_z);
  surface.finish = Finish::kPaint;
  // Hardly two walls of a home are equally white.
  Random random(PartSeed(home.seed, static_cast<uint64_t>(1000 + wall.id)));
  surface.rgb = room.wall_rgb * static_cast<float>(random.Uniform(0.975, 1.025));
  surface.label = SurfaceLabel::kWall;
  surface.room_id = room.id;
  surface.wall_id = wall.id;
  list.Add(std::move(surface));
}

int WallIdOf(const Home& home, const HomeOpening& opening) {
  for (const HomeWall& wall : HomeWalls(home)) {
    if (wall.room_id == opening.room_id && OpeningOnWall(opening, wall)) return wall.id;
  }
  return -1;
}

void AddReveals(const Home& home, const HomeOpening& opening, SurfaceList& list) {
  const HomeRoom& room = home.RoomById(opening.room_id);
  const Vector3d through = At(opening.thickness_m * opening.IntoWall(), 0);
  const Vector3d along = At(opening.b - opening.a, 0), up(0, 0, opening.head_z - opening.sill_z);
  const Vector3d low = At(opening.a, opening.sill_z);
  SurfaceTraits traits;
  traits.finish = Finish::kPlain;
  traits.rgb =
      opening.kind == OpeningKind::kOpening ? room.wall_rgb : Vector3f(0.76f, 0.75f, 0.72f);
  traits.label = SurfaceLabel::kWall;
  traits.room_id = room.id;
  traits.wall_id = WallIdOf(home, opening);
  list.AddRectangle(low, through, up, along, traits);
  list.AddRectangle(low + along, through, up, -along, traits);
  list.AddRectangle(low + up, along, through, -up, traits);
  if (opening.kind != OpeningKind::kWindow) {
    traits.finish = room.floor_finish;
    traits.rgb = room.floor_rgb;
    traits.label = SurfaceLabel::kFloor;
    traits.wall_id = -1;
  }
  list.AddRectangle(low, along, through, up, traits);
}

}  // namespace

void AddShell(const Home& home, SurfaceList& list) {
  for (const HomeRoom& room : home.rooms) {
    AddLevel(room, true, list);
    AddLevel(room, false, list);
  }
  for (const HomeWall& wall : HomeWalls(home)) AddWall(home, wall, list);
  for (const HomeOpening& opening : home.openings) AddReveals(home, opening, list);
}

}  // namespace enfilade
