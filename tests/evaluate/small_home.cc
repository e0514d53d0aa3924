// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/evaluate/small_home.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "enfilade/exchange/npy.h"
#include "enfilade/exchange/pixel_truth.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr int kNumColumns = 360;
constexpr double kHeading_rad = DegToRad(20);
constexpr double kCameraHeight_m = 1.4;
constexpr double kCeilings_m[] = {2.4, 2.5, 2.6};
const Vector2d kCameras[] = {{1.3, 1.2}, {6.5, 1.7}, {3.9, 3.8}};

Rigid3 HomeFromWorld() { return {RotationZ(-kHeading_rad), {0, 0, 0}}; }

Vector2d ToHome(const Vector2d& p) {
  return (HomeFromWorld() * Vector3d(p.x(), p.y(), 0)).head<2>();
}

// An upright camera at (x, y), looking along the azimuth `yaw_rad`.
Rigid3 UprightCamera(const Vector2d& position, double yaw_rad) {
  Rigid3 pose;
  pose.rotation.col(0) = Vector3d(std::sin(yaw_rad), -std::cos(yaw_rad), 0);  // right
  pose.rotation.col(1) = Vector3d(0, 0, -1);                                  // down
  pose.rotation.col(2) = Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0);   // forward
  pose.translation = Vector3d(position.x(), position.y(), kCameraHeight_m);
  return pose;
}

// What a ray meets in a closed room.
struct RoomHit {
  double distance_m;
  SurfaceLabel label;
  Vector3d normal;
};

RoomHit CastInRoom(const Ring2& room, double ceiling_z, const Vector3d& camera,
                   const Vector3d& ray) {
  const double level = ray.head<2>().norm();
  const double wall_m = RayDistance(room, camera.head<2>(), ray.head<2>() / level) / level;
  const double flat_m = ray.z() < 0 ? -camera.z() / ray.z() : (ceiling_z - camera.z()) / ray.z();
  if (flat_m < wall_m) {
    return {flat_m, ray.z() < 0 ? SurfaceLabel::kFloor : SurfaceLabel::kCeiling,
            Vector3d(0, 0, ray.z() < 0 ? 1 : -1)};
  }
  // The rooms are along the axes: the wall faces the axis on whose edge the point lies.
  const Vector2d p = (camera + wall_m * ray).head<2>();
  const bool is_across_x = std::any_of(room.begin(), room.end(), [&](const Vector2d& corner) {
    return std::abs(corner.x() - p.x()) < 1e-9;
  });
  const int axis = is_across_x ? 0 : 1;
  Vector3d normal = Vector3d::Zero();
  normal[axis] = ray[axis] > 0 ? -1 : 1;
  return {wall_m, SurfaceLabel::kWall, normal};
}

// Every edge of the rooms less the doors, by hand: the doors lie on the horizontal edges.
std::vector<std::array<Vector2d, 2>> Walls() {
  return {{Vector2d(0, 0), Vector2d(4, 0)},         {Vector2d(4, 0), Vector2d(4, 3)},
          {Vector2d(4, 3), Vector2d(1.9, 3)},       {Vector2d(1, 3), Vector2d(0, 3)},
          {Vector2d(0, 3), Vector2d(0, 0)},         {Vector2d(4.1, 0), Vector2d(8.1, 0)},
          {Vector2d(8.1, 0), Vector2d(8.1, 3)},     {Vector2d(8.1, 3), Vector2d(6.9, 3)},
          {Vector2d(6, 3), Vector2d(4.1, 3)},       {Vector2d(4.1, 3), Vector2d(4.1, 0)},
          {Vector2d(0, 3.1), Vector2d(1, 3.1)},     {Vector2d(1.9, 3.1), Vector2d(6, 3.1)},
          {Vector2d(6.9, 3.1), Vector2d(8.1, 3.1)}, {Vector2d(8.1, 3.1), Vector2d(8.1, 4.6)},
          {Vector2d(8.1, 4.6), Vector2d(0, 4.6)},   {Vector2d(0, 4.6), Vector2d(0, 3.1)}};
}

WallProfile MakeProfile(int view_idx, const Ring2& room, const Vector2d& camera, double ceiling_z) {
  WallProfile profile;
  profile.view_idx = view_idx;
  profile.ceiling_z = ceiling_z;
  for (int c = 0; c < kNumColumns; ++c) {
    const double azimuth = AzimuthOfColumn(c, kNumColumns) + kHeading_rad;
    const double r = RayDistance(room, camera, Vector2d(std::cos(azimuth), std::sin(azimuth)));
    profile.wall_m.push_back(static_cast<float>(r));
  }
  profile.obstacle_m = profile.wall_m;
  profile.confidence.assign(kNumColumns, 1.0F);
  profile.is_seen.assign(kNumColumns, 1);
  return profile;
}

}  // namespace

std::vector<Ring2> SmallHomeRooms() {
  return {ParseRing("0,0 4,0 4,3 0,3"), ParseRing("4.1,0 8.1,0 8.1,3 4.1,3"),
          ParseRing("0,3.1 8.1,3.1 8.1,4.6 0,4.6")};
}

std::vector<Opening> SmallHomeDoors() {
  Opening left;
  left.a = Vector2d(1.0, 3.05);
  left.b = Vector2d(1.9, 3.05);
  left.head_z = 2.0;
  left.room_id = 0;
  left.other_room_id = 2;
  Opening right = left;
  right.id = 1;
  right.a = Vector2d(6.0, 3.05);
  right.b = Vector2d(6.9, 3.05);
  right.room_id = 1;
  return {left, right};
}

Floorplan MakePlan(const std::vector<Ring2>& rooms_in_world,
                   const std::vector<Opening>& openings_in_world) {
  Floorplan plan;
  plan.home_from_world = HomeFromWorld();
  Storey storey;
  for (size_t i = 0; i < rooms_in_world.size(); ++i) {
    Room room;
    room.id = static_cast<int>(i);
    for (const Vector2d& p : rooms_in_world[i]) room.polygon.outer.push_back(ToHome(p));
    room.ceiling_z = kCeilings_m[i % std::size(kCeilings_m)];
    storey.rooms.push_back(room);
    const Ring2& ring = room.polygon.outer;
    for (size_t k = 0; k < ring.size(); ++k) {
      Wall wall;
      wall.id = static_cast<int>(storey.walls.size());
      wall.a = ring[k];
      wall.b = ring[(k + 1) % ring.size()];
      wall.room_id = room.id;
      wall.thickness_m = 0.1;
      wall.seen = static_cast<WallSeen>(wall.id % 3);
      wall.sigma_m = 0.02;
      storey.walls.push_back(wall);
    }
  }
  for (Opening opening : openings_in_world) {
    opening.a = ToHome(opening.a);
    opening.b = ToHome(opening.b);
    storey.openings.push_back(opening);
  }
  plan.storeys.push_back(storey);
  return plan;
}

void WritePixelTruth(const std::filesystem::path& folder, SmallHome& home) {
  constexpr int kRows = 32, kCols = 64;
  const Camera camera = EquirectangularCamera(kCols, kRows);
  const std::vector<Ring2> rooms = SmallHomeRooms();
  for (size_t i = 0; i < rooms.size(); ++i) {
    TruthView& view = home.truth.views[i];
    ImageF depth(kRows, kCols);
    Image<int8_t> normals(kRows, kCols, 3);
    ImageU8 labels(kRows, kCols);
    for (int row = 0; row < kRows; ++row) {
      for (int col = 0; col < kCols; ++col) {
        const Vector3d ray =
            view.world_from_cam->rotation * camera.RayFromPixel({col + 0.5, row + 0.5});
        const RoomHit hit =
            CastInRoom(rooms[i], kCeilings_m[i], view.world_from_cam->translation, ray);
        depth(row, col) = static_cast<float>(hit.distance_m);
        labels(row, col) = static_cast<uint8_t>(hit.label);
        for (int k = 0; k < 3; ++k) normals(row, col, k) = static_cast<int8_t>(127 * hit.normal[k]);
      }
    }
    const std::string stem = std::to_string(i);
    view.depth_path = folder / ("depth_" + stem + ".npy");
    view.normals_path = folder / ("normals_" + stem + ".npy");
    view.labels_path = folder / ("labels_" + stem + ".png");
    WriteNpy(view.depth_path, depth);
    WriteNpy(view.normals_path, normals);
    WriteImage(view.labels_path, labels);
  }
}

SmallHome MakeSmallHome() {
  SmallHome home;
  const std::vector<Ring2> rooms = SmallHomeRooms();
  home.plan = MakePlan(rooms, SmallHomeDoors());
  home.scene.pose_source = PoseSource::kTransforms;
  home.structure.home_from_world = HomeFromWorld();
  home.structure.heading_rad = kHeading_rad;
  home.structure.storeys.push_back({0.0, 2.5, 0.0});
  home.truth.walls = Walls();
  for (const Opening& door : SmallHomeDoors()) home.truth.doors.push_back({door.a, door.b});
  for (int i = 0; i < static_cast<int>(rooms.size()); ++i) {
    const size_t room = static_cast<size_t>(i);
    home.truth.rooms.push_back({.region = {{rooms[room], {}}},
                                .floor_z = 0.0,
                                .ceiling_z = kCeilings_m[i],
                                .joined_to = {},
                                .passages = {}});
    TruthView truth;
    truth.picture = "picture_" + std::to_string(i) + ".jpg";
    truth.sha256 = std::string(64, static_cast<char>('a' + i));
    truth.world_from_cam = UprightCamera(kCameras[i], 0.7 * i);
    truth.camera_height_m = kCameraHeight_m;
    truth.visible_layout = rooms[room];
    truth.doors = home.truth.doors;
    home.truth.views.push_back(truth);
    View view;
    view.picture = truth.picture;
    view.sha256 = truth.sha256;
    view.camera = EquirectangularCamera(1024, 512);
    view.world_from_cam = *truth.world_from_cam;
    home.scene.views.push_back(view);
    home.plan.cameras.push_back({view.picture, view.sha256, 0, 0, false, view.world_from_cam});
    home.structure.profiles.push_back(MakeProfile(i, rooms[room], kCameras[i], kCeilings_m[i]));
  }
  return home;
}

}  // namespace enfilade
