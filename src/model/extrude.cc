// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/model/extrude.h"

#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/floorplan/wall_lookup.h"
#include "enfilade/geometry/triangulate.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d AtHeight(const Vector2d& p, double z) { return {p.x(), p.y(), z}; }

ModelFace LevelFace(SurfaceKind kind, const Room& room, const Triangulation2& triangulation) {
  const bool is_floor = kind == SurfaceKind::kFloor;
  ModelFace face;
  face.kind = kind;
  face.normal = is_floor ? Vector3d::UnitZ() : Vector3d(-Vector3d::UnitZ());
  for (const Vector2d& p : triangulation.vertices) {
    face.vertices.push_back(AtHeight(p, is_floor ? room.floor_z : room.ceiling_z));
  }
  for (const std::array<int, 3>& t : triangulation.triangles) {
    face.triangles.push_back(is_floor ? t : std::array<int, 3>{t[0], t[2], t[1]});
  }
  return face;
}

// The room lies on the left of a → b: along outer rings and along holes alike.
ModelFace WallFace(const Room& room, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = (b - a).normalized();
  ModelFace face;
  face.kind = SurfaceKind::kWall;
  face.normal = Vector3d(-along.y(), along.x(), 0);
  face.vertices = {AtHeight(a, room.floor_z), AtHeight(b, room.floor_z),
                   AtHeight(b, room.ceiling_z), AtHeight(a, room.ceiling_z)};
  face.triangles = {{0, 2, 1}, {0, 3, 2}};
  return face;
}

void AppendWalls(const Storey& storey, const Room& room, const Ring2& ring,
                 std::vector<ModelFace>& faces) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % ring.size()];
    faces.push_back(WallFace(room, a, b));
    const Wall* wall = FindWallOfEdge(storey, room.id, a, b);
    if (wall != nullptr) faces.back().wall_id = wall->id;
  }
}

std::vector<ModelFace> ExtrudeRoom(const Storey& storey, const Room& room) {
  ENFILADE_CHECK_MSG(room.ceiling_z > room.floor_z, "room " + std::to_string(room.id));
  const Triangulation2 triangulation = Triangulate(room.polygon);
  std::vector<ModelFace> faces{LevelFace(SurfaceKind::kFloor, room, triangulation),
                               LevelFace(SurfaceKind::kCeiling, room, triangulation)};
  AppendWalls(storey, room, room.polygon.outer, faces);
  for (const Ring2& hole : room.polygon.holes) AppendWalls(storey, room, hole, faces);
  return faces;
}

}  // namespace

BuildingModel ExtrudeFloorplan(const Floorplan& plan) {
  BuildingModel model;
  for (size_t s = 0; s < plan.storeys.size(); ++s) {
    for (const Room& room : plan.storeys[s].rooms) {
      for (ModelFace& face : ExtrudeRoom(plan.storeys[s], room)) {
        face.storey_idx = static_cast<int>(s);
        face.room_id = room.id;
        model.faces.push_back(std::move(face));
      }
    }
  }
  return model;
}

}  // namespace enfilade
