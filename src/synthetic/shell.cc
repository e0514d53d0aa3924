// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "enfilade/geometry/triangulate.h"
#include "src/synthetic/outline.h"
#include "src/synthetic/random.h"
#include "src/synthetic/surface.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3d At(const Vector2d& p, double z) { return {p.x(), p.y(), z}; }

void AddLevel(const HomeRoom& room, bool is_floor, SurfaceList& list) {
  const Triangulation2 triangulation = Triangulate(room.polygon);
  const Vector2d slope = is_floor ? Vector2d(0, 0) : room.ceiling_slope;
  const Vector3d up = Vector3d(-slope.x(), -slope.y(), 1).normalized();
  const Vector3d axis_u = Vector3d(1, 0, slope.x()).normalized(), axis_v = up.cross(axis_u);
  // Vertices in the plane's own axes; their least ones become the origin.
  const Vector2d corner = triangulation.vertices[0];
  const Vector3d start = At(corner, is_floor ? room.floor_z : room.CeilingAt(corner));
  std::vector<Vector2d> places;
  for (const Vector2d& p : triangulation.vertices) {
    const Vector3d offset = At(p, is_floor ? room.floor_z : room.CeilingAt(p)) - start;
    places.emplace_back(axis_u.dot(offset), axis_v.dot(offset));
  }
  const Rectangle bounds = BoundsOf(places);
  Surface surface;
  surface.origin = (start + bounds.min.x() * axis_u + bounds.min.y() * axis_v).cast<float>();
  surface.axis_u = axis_u.cast<float>();
  surface.axis_v = axis_v.cast<float>();
  surface.normal = (is_floor ? up : -up).cast<float>();
  surface.extent = bounds.Size().cast<float>();
  for (const Vector2d& p : places) surface.vertices.push_back((p - bounds.min).cast<float>());
  surface.triangles = triangulation.triangles;
  surface.finish = is_floor ? room.floor_finish : Finish::kPaint;
  surface.rgb = is_floor ? room.floor_rgb : room.ceiling_rgb;
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

// Adds the part of a wall over [u0, u1], from z0 up to the heights z1 at u0 and u1; heights count
// from the floor.
void AddPanel(Surface& surface, double u0, double u1, double z0, const Vector2d& z1) {
  if (u1 - u0 < 1e-9 || z1.minCoeff() - z0 < 1e-9) return;
  const int first = static_cast<int>(surface.vertices.size());
  for (const Vector2d& p :
       {Vector2d(u0, z0), Vector2d(u1, z0), Vector2d(u1, z1[1]), Vector2d(u0, z1[0])}) {
    surface.vertices.push_back(p.cast<float>());
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
  const auto ceiling = [&](double u) {
    return room.CeilingAt(wall.a + u * wall.Along()) - room.floor_z;
  };
  surface.extent = Vector2d(length_m, std::max(ceiling(0), ceiling(length_m))).cast<float>();
  const auto add_full = [&](double u0, double u1, double z0) {
    AddPanel(surface, u0, u1, z0, {ceiling(u0), ceiling(u1)});
  };
  double begin_m = 0;
  for (const Hole& hole : HolesIn(home, wall)) {
    const double sill_m = hole.sill_z - room.floor_z, head_m = hole.head_z - room.floor_z;
    add_full(begin_m, hole.begin_m, 0);
    AddPanel(surface, hole.begin_m, hole.end_m, 0, {sill_m, sill_m});
    add_full(hole.begin_m, hole.end_m, head_m);
    begin_m = hole.end_m;
  }
  add_full(begin_m, length_m, 0);
  surface.finish = room.wall_finish;
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
