// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/truth.h"

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/cross.h"
#include "enfilade/geometry/triangulate.h"
#include "src/synthetic/openings.h"
#include "src/synthetic/placement.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHanging_m = 0.5;
constexpr double kMaxThickness_m = 0.5;

// The longest neighbour behind each wall face, by the face's id.
void AddNeighbours(const Home& home, std::vector<Wall>& walls) {
  std::vector<double> longest_m(walls.size(), 0);
  const std::vector<HomeWall> faces = HomeWalls(home);
  const auto offer = [&](size_t wall_idx, const SharedWall& shared, int other_room_id) {
    const double length_m = shared.end_m - shared.begin_m;
    if (length_m <= longest_m[wall_idx]) return;
    longest_m[wall_idx] = length_m;
    walls[wall_idx].other_room_id = other_room_id;
    walls[wall_idx].thickness_m = shared.thickness_m;
  };
  for (const SharedWall& shared : FindSharedWalls(home, kMaxThickness_m, 0.05)) {
    offer(static_cast<size_t>(shared.wall.id), shared, shared.other_room_id);
    const Vector2d middle =
        shared.wall.a + 0.5 * (shared.begin_m + shared.end_m) * shared.wall.Along();
    for (const HomeWall& face : faces) {
      const Vector2d across = middle - shared.thickness_m * shared.wall.Inward();
      if (face.room_id == shared.other_room_id &&
          DistanceToSegment(across, face.a, face.b) < 1e-6) {
        offer(static_cast<size_t>(face.id), shared, shared.wall.room_id);
      }
    }
  }
}

std::vector<Wall> TruthWalls(const Home& home) {
  std::vector<Wall> walls;
  for (const HomeWall& face : HomeWalls(home)) {
    Wall wall;
    wall.id = face.id;
    wall.a = face.a;
    wall.b = face.b;
    wall.room_id = face.room_id;
    wall.is_thickness_measured = true;
    walls.push_back(wall);
  }
  AddNeighbours(home, walls);
  return walls;
}

std::vector<Opening> TruthOpenings(const Home& home) {
  std::vector<Opening> openings;
  for (const HomeOpening& hole : home.openings) {
    Opening opening;
    opening.id = hole.id;
    opening.kind = hole.kind;
    opening.a = hole.a;
    opening.b = hole.b;
    opening.sill_z = hole.sill_z;
    opening.head_z = hole.head_z;
    opening.room_id = hole.room_id;
    opening.other_room_id = hole.other_room_id;
    for (const HomeWall& wall : HomeWalls(home)) {
      if (wall.room_id == hole.room_id && OpeningOnWall(hole, wall)) opening.wall_id = wall.id;
    }
    openings.push_back(opening);
  }
  return openings;
}

// The parts of a wall face that no passable opening breaks.
void AddSolidParts(const Home& home, const HomeWall& wall, std::vector<PlanSegment>& segments) {
  std::vector<std::pair<double, double>> gaps;
  for (const HomeOpening& opening : home.openings) {
    const auto gap = OpeningOnWall(opening, wall);
    if (gap && opening.IsPassable()) gaps.push_back(*gap);
  }
  const double length_m = (wall.b - wall.a).norm();
  gaps.emplace_back(length_m, length_m);
  std::sort(gaps.begin(), gaps.end());
  double begin_m = 0;
  for (const auto& [from_m, to_m] : gaps) {
    if (from_m - begin_m > 1e-9) {
      segments.push_back(
          {wall.a + begin_m * wall.Along(), wall.a + from_m * wall.Along(), wall.room_id, wall.id});
    }
    begin_m = to_m;
  }
}

void AddRing(const Ring2& ring, int room_id, std::vector<PlanSegment>& segments) {
  for (size_t i = 0; i < ring.size(); ++i) {
    segments.push_back({ring[i], ring[(i + 1) % ring.size()], room_id, -1});
  }
}

double MeanCeiling(const HomeRoom& room) {
  if (room.HasLevelCeiling()) return room.ceiling_z;
  const Triangulation2 parts = Triangulate(room.polygon);
  double volume_m3 = 0;
  for (const std::array<int, 3>& t : parts.triangles) {
    const Vector2d &a = parts.vertices[static_cast<size_t>(t[0])],
                   &b = parts.vertices[static_cast<size_t>(t[1])],
                   &c = parts.vertices[static_cast<size_t>(t[2])];
    volume_m3 += 0.5 * Cross(b - a, c - a) * room.CeilingAt((a + b + c) / 3);
  }
  return volume_m3 / Area(room.polygon);
}

// Whether the box stands between two points: clips the segment by its faces, in its own axes.
bool StandsBetween(const HomeBox& box, const Vector3d& from, const Vector3d& to) {
  const Eigen::Rotation2Dd back(-box.yaw_rad);
  const auto local = [&](const Vector3d& p) {
    const Vector2d q = back * (p.head<2>() - box.center);
    return Vector3d(q.x(), q.y(), p.z() - 0.5 * (box.z0 + box.z1));
  };
  const Vector3d origin = local(from), step = local(to) - origin;
  const Vector3d half(0.5 * box.size.x(), 0.5 * box.size.y(), 0.5 * (box.z1 - box.z0));
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    const double a = (-half[k] - origin[k]) / step[k], b = (half[k] - origin[k]) / step[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

}  // namespace

double HiddenFloorLineShare(const Home& home) {
  constexpr int kDirections = 360;
  std::vector<PlanSegments> storeys;
  for (int i = 0; i < home.NumStoreys(); ++i) storeys.push_back(MakePlanSegments(home, i));
  int num_seen = 0, num_hidden = 0;
  for (const HomeCamera& camera : home.cameras) {
    const int storey_idx = home.RoomById(camera.room_id).storey_idx;
    const PlanSegments& segments = storeys[static_cast<size_t>(storey_idx)];
    const Vector3d eye = camera.home_from_cam.translation;
    const double floor_z = home.RoomById(camera.room_id).floor_z;
    for (int i = 0; i < kDirections; ++i) {
      const double azimuth = 2 * kPi * (i + 0.5) / kDirections;
      const Vector2d direction(std::cos(azimuth), std::sin(azimuth));
      const auto hit = CastPlanRay(segments.walls, eye.head<2>(), direction);
      if (!hit || segments.walls[static_cast<size_t>(hit->segment_idx)].wall_id < 0) continue;
      const Vector2d foot = eye.head<2>() + hit->distance_m * direction;
      const Vector3d seen(foot.x(), foot.y(), floor_z);
      const bool is_hidden =
          std::any_of(home.boxes.begin(), home.boxes.end(),
                      [&](const HomeBox& box) { return StandsBetween(box, eye, seen); });
      (is_hidden ? num_hidden : num_seen) += 1;
    }
  }
  const int total = num_seen + num_hidden;
  return total > 0 ? static_cast<double>(num_hidden) / total : 0;
}

Floorplan TruthFloorplan(const Home& home) {
  Floorplan plan;
  plan.home_from_world = home.home_from_world;
  plan.storeys.resize(static_cast<size_t>(home.NumStoreys()));
  for (size_t i = 0; i < plan.storeys.size(); ++i) plan.storeys[i].id = static_cast<int>(i);
  const auto storey_of = [&](int room_id) -> Storey& {
    return plan.storeys[static_cast<size_t>(home.RoomById(room_id).storey_idx)];
  };
  for (const HomeRoom& room : home.rooms) {
    Storey& storey = storey_of(room.id);
    if (storey.rooms.empty()) storey.floor_z = room.floor_z;
    storey.rooms.push_back({.id = room.id,
                            .polygon = room.polygon,
                            .floor_z = room.floor_z,
                            .ceiling_z = MeanCeiling(room),
                            .has_level_ceiling = room.HasLevelCeiling()});
  }
  for (Wall& wall : TruthWalls(home)) storey_of(wall.room_id).walls.push_back(wall);
  for (Opening& opening : TruthOpenings(home))
    storey_of(opening.room_id).openings.push_back(opening);
  for (size_t i = 0; i < home.cameras.size(); ++i) {
    PlanCamera camera;
    camera.picture = home.cameras[i].picture;
    camera.storey_idx = home.StoreyOfCamera(static_cast<int>(i));
    camera.world_from_cam = home.WorldFromCamera(static_cast<int>(i));
    plan.cameras.push_back(camera);
  }
  return plan;
}

PlanSegments MakePlanSegments(const Home& home, int storey_idx) {
  PlanSegments segments;
  for (const HomeWall& wall : HomeWalls(home)) {
    if (home.IsOnStorey(wall.room_id, storey_idx)) AddSolidParts(home, wall, segments.walls);
  }
  for (const HomeOpening& opening : home.openings) {
    if (!home.IsOnStorey(opening.room_id, storey_idx)) continue;
    if (opening.leaf == DoorLeaf::kOpen) {
      AddRing(OpenLeaf(opening).Footprint(), opening.room_id, segments.obstacles);
    }
    if (!opening.IsPassable()) continue;
    const Vector2d through = opening.thickness_m * opening.IntoWall();
    segments.walls.push_back({opening.a, opening.a + through, opening.room_id, -1});
    segments.walls.push_back({opening.b + through, opening.b, opening.room_id, -1});
  }
  for (const HomeBox& box : home.boxes) {
    const HomeRoom& room = home.RoomById(box.room_id);
    if (room.storey_idx != storey_idx || box.z0 - room.floor_z > kHanging_m) continue;
    AddRing(box.Footprint(), box.room_id, segments.obstacles);
  }
  return segments;
}

std::optional<PlanHit> CastPlanRay(const std::vector<PlanSegment>& segments, const Vector2d& origin,
                                   const Vector2d& direction) {
  std::optional<PlanHit> nearest;
  for (size_t i = 0; i < segments.size(); ++i) {
    const Vector2d to_a = segments[i].a - origin, edge = segments[i].b - segments[i].a;
    const double denominator = Cross(direction, edge);
    if (denominator == 0) continue;
    const double distance_m = Cross(to_a, edge) / denominator;
    const double along = Cross(to_a, direction) / denominator;
    if (distance_m < 0 || along < 0 || along > 1) continue;
    if (!nearest || distance_m < nearest->distance_m)
      nearest = PlanHit{distance_m, static_cast<int>(i)};
  }
  return nearest;
}

}  // namespace enfilade
