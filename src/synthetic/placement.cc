// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/boolean.h"
#include "src/synthetic/furniture.h"

namespace enfilade {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;

constexpr double kWallGap_m = 0.025;  // clear of the baseboard
constexpr double kItemGap_m = 0.08;
constexpr double kDoorDepth_m = 0.9;
constexpr double kLeafThickness_m = 0.04;
constexpr double kCameraClearance_m = 0.65;
constexpr double kHallClearance_m = 0.42;
constexpr double kCameraSpacing_m = 1.6;
// A place from which a whole room comes into view is worth this much clearance.
constexpr double kViewWeight_m = 2.0;
constexpr double kTwoCamerasArea_m2 = 13;
constexpr double kMinOverlap_m2 = 1e-7;

bool Overlap(const MultiPolygon2& a, const MultiPolygon2& b) {
  return Area(Intersection(a, b)) > kMinOverlap_m2;
}

Ring2 RectangleRing(const Vector2d& low, const Vector2d& high, const Vector2d& origin,
                    double yaw_rad) {
  const Rotation2Dd turn(yaw_rad);
  return {origin + turn * low, origin + turn * Vector2d(high.x(), low.y()), origin + turn * high,
          origin + turn * Vector2d(low.x(), high.y())};
}

std::vector<Ring2> RingsOf(const Polygon2& polygon) {
  std::vector<Ring2> rings = {polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  return rings;
}

// Where a piece stands: its back's middle and its heading.
struct Stand {
  Vector2d origin;
  double yaw_rad;
};

Ring2 PieceFootprint(const FurniturePiece& piece, const Stand& stand, double margin_m) {
  const double half = 0.5 * piece.footprint.x() + margin_m;
  return RectangleRing({-half, -std::min(margin_m, 0.5 * kWallGap_m)},
                       {half, piece.footprint.y() + margin_m}, stand.origin, stand.yaw_rad);
}

// The region of a room that furniture must leave free.
struct RoomBlocks {
  MultiPolygon2 everywhere;  ///< doors, furniture that is there
  MultiPolygon2 windows;     ///< in front of windows: low pieces only
};

RoomBlocks BlocksOf(const Home& home, const HomeRoom& room) {
  RoomBlocks blocks;
  for (const HomeBox& box : home.boxes) {
    if (box.room_id == room.id) blocks.everywhere.push_back({box.Footprint(), {}});
  }
  for (const HomeOpening& opening : home.openings) {
    if (opening.kind == OpeningKind::kWindow) {
      const Vector2d in = -0.6 * opening.IntoWall();
      if (opening.room_id == room.id) {
        blocks.windows.push_back({{opening.b, opening.b + in, opening.a + in, opening.a}, {}});
      }
    } else {
      for (Polygon2& part : DoorClearance(opening)) blocks.everywhere.push_back(std::move(part));
    }
  }
  return blocks;
}

Stand RandomStand(const Home& home, const HomeRoom& room, const FurniturePiece& piece,
                  Random& random) {
  const std::vector<HomeWall> walls = HomeWalls(home);
  std::vector<HomeWall> own;
  std::copy_if(walls.begin(), walls.end(), std::back_inserter(own),
               [&](const HomeWall& wall) { return wall.room_id == room.id; });
  const HomeWall& wall = own[static_cast<size_t>(random.Index(static_cast<int>(own.size())))];
  const double yaw_rad = std::atan2(wall.Along().y(), wall.Along().x());
  const double along_m = random.Millimetres(0, (wall.b - wall.a).norm());
  const double off_m = piece.is_against_wall ? kWallGap_m : random.Millimetres(0.3, 2.0);
  return {wall.a + along_m * wall.Along() + off_m * wall.Inward(), yaw_rad};
}

void AddPiece(Home& home, const HomeRoom& room, const FurniturePiece& piece, const Stand& stand,
              int item) {
  for (HomeBox box : piece.boxes) {
    box.item = item;
    box.room_id = room.id;
    box.center = stand.origin + Rotation2Dd(stand.yaw_rad) * box.center;
    box.yaw_rad = stand.yaw_rad;
    box.z0 += room.floor_z;
    box.z1 += room.floor_z;
    home.boxes.push_back(box);
  }
}

bool TryPlacePiece(Home& home, const HomeRoom& room, const FurniturePiece& piece, int item,
                   RoomBlocks& blocks, Random& random) {
  constexpr int kTries = 60;
  for (int i = 0; i < kTries; ++i) {
    const Stand stand = RandomStand(home, room, piece, random);
    const MultiPolygon2 footprint = {{PieceFootprint(piece, stand, 0), {}}};
    if (Area(Difference(footprint, {room.polygon})) > kMinOverlap_m2) continue;
    const MultiPolygon2 wide = {{PieceFootprint(piece, stand, kItemGap_m), {}}};
    if (Overlap(wide, blocks.everywhere) || (piece.is_tall && Overlap(wide, blocks.windows)))
      continue;
    AddPiece(home, room, piece, stand, item);
    blocks.everywhere.push_back(footprint[0]);
    return true;
  }
  return false;
}

// The place on a 10 cm grid that is farthest from the polygon's boundary.
Vector2d InnermostPlace(const Polygon2& polygon) {
  Vector2d low = polygon.outer[0], high = low, best = low;
  for (const Vector2d& p : polygon.outer) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double best_m = 0;
  for (double x = low.x() + 0.05; x < high.x(); x += 0.1) {
    for (double y = low.y() + 0.05; y < high.y(); y += 0.1) {
      if (!Contains(polygon, {x, y})) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Ring2& ring : RingsOf(polygon)) {
        for (size_t i = 0; i < ring.size(); ++i) {
          nearest =
              std::min(nearest, DistanceToSegment({x, y}, ring[i], ring[(i + 1) % ring.size()]));
        }
      }
      if (nearest <= best_m + 1e-6) continue;
      best_m = nearest;
      best = {x, y};
    }
  }
  return best;
}

// True when no wall of the room stands between two places in it.
bool Sees(const HomeRoom& room, const Vector2d& from, const Vector2d& to) {
  const double distance_m = (to - from).norm();
  if (distance_m == 0) return true;
  return RayDistance(room.polygon.outer, from, (to - from) / distance_m) >= distance_m;
}

// Points of a room on a coarse grid that none of `taken` sees past the room's own corners.
std::vector<Vector2d> UnseenPoints(const HomeRoom& room, const Vector2d& low, const Vector2d& high,
                                   const std::vector<Vector2d>& taken) {
  constexpr double kStep_m = 0.3;
  std::vector<Vector2d> points;
  for (double y = low.y() + kStep_m / 2; y < high.y(); y += kStep_m) {
    for (double x = low.x() + kStep_m / 2; x < high.x(); x += kStep_m) {
      const Vector2d p(x, y);
      const bool is_seen = std::any_of(taken.begin(), taken.end(),
                                       [&](const Vector2d& q) { return Sees(room, q, p); });
      if (Contains(room.polygon, p) && !is_seen) points.push_back(p);
    }
  }
  return points;
}

// The best of many random places, none when all are too narrow or too near to `taken`: clear of
// walls and furniture, and with much of the room in view that was not seen yet.
std::optional<Vector2d> ClearestPlace(const Home& home, const HomeRoom& room,
                                      const std::vector<Vector2d>& taken, Random& random) {
  constexpr int kTries = 150;
  Vector2d low = room.polygon.outer[0], high = low;
  for (const Vector2d& p : room.polygon.outer) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const std::vector<Vector2d> unseen = UnseenPoints(room, low, high, taken);
  const double min_clear_m = room.use == RoomUse::kHall ? kHallClearance_m : kCameraClearance_m;
  double best_value = 0;
  std::optional<Vector2d> best;
  for (int i = 0; i < kTries; ++i) {
    const Vector2d p(random.Millimetres(low.x(), high.x()), random.Millimetres(low.y(), high.y()));
    // Beyond 1.2 m one place is as good as another: cameras need not stand in the middle.
    const double clear_m = std::min(Clearance(home, room.id, p), random.Uniform(1.1, 1.2));
    const bool is_apart = std::all_of(taken.begin(), taken.end(), [&](const Vector2d& q) {
      return (p - q).norm() > kCameraSpacing_m;
    });
    if (!is_apart || clear_m <= min_clear_m) continue;
    const auto num_new = std::count_if(unseen.begin(), unseen.end(),
                                       [&](const Vector2d& q) { return Sees(room, p, q); });
    const double share = static_cast<double>(num_new) / static_cast<double>(unseen.size() + 1);
    const double value = clear_m + kViewWeight_m * share;
    if (value <= best_value) continue;
    best_value = value;
    best = p;
  }
  return best;
}

// The places of a room's cameras, in the order in which they were taken.
struct RoomCameras {
  const HomeRoom* room = nullptr;
  std::vector<Vector2d> places;
  bool is_full = false;
};

bool AddPlace(const Home& home, RoomCameras& cameras, Random& random) {
  const std::optional<Vector2d> place = ClearestPlace(home, *cameras.room, cameras.places, random);
  if (place) cameras.places.push_back(*place);
  cameras.is_full = !place;
  return place.has_value();
}

void AddCameras(Home& home, const RoomCameras& cameras, double height_m, double jitter_m,
                Random& random) {
  for (const Vector2d& p : cameras.places) {
    const double z = cameras.room->floor_z + height_m + random.Uniform(-jitter_m, jitter_m);
    AddCamera(home, cameras.room->id, {p.x(), p.y(), z}, random.Uniform(-kPi, kPi));
  }
}

}  // namespace

HomeBox OpenLeaf(const HomeOpening& door) {
  // Closed, the leaf fills the hole flush with the room's face; it swings about its hinge into the
  // room.
  const Vector2d hinge = door.is_hinge_at_a ? door.a : door.b;
  const Vector2d closed = (door.is_hinge_at_a ? door.b - door.a : door.a - door.b);
  const double turn = door.is_hinge_at_a ? door.leaf_angle_rad : -door.leaf_angle_rad;
  const Vector2d open = Rotation2Dd(turn) * closed;
  HomeBox leaf;
  leaf.item = -1;
  leaf.room_id = door.room_id;
  leaf.size = {closed.norm() - 0.02, kLeafThickness_m};
  leaf.yaw_rad = std::atan2(open.y(), open.x());
  leaf.center = hinge + 0.5 * open - 0.03 * door.IntoWall();
  leaf.z0 = door.sill_z + 0.008;
  leaf.z1 = door.head_z - 0.01;
  leaf.rgb = {0.72f, 0.71f, 0.68f};
  return leaf;
}

MultiPolygon2 DoorClearance(const HomeOpening& door) {
  const Vector2d along = 0.1 * (door.b - door.a).normalized(), out = door.IntoWall();
  const Vector2d back = -kDoorDepth_m * out, front = (door.thickness_m + kDoorDepth_m) * out;
  // a → b has the room on its left, so back lies left of it.
  MultiPolygon2 region = {{{door.a - along + front, door.b + along + front, door.b + along + back,
                            door.a - along + back},
                           {}}};
  if (door.leaf == DoorLeaf::kOpen) region.push_back({OpenLeaf(door).Footprint(), {}});
  return region;
}

void FurnishRooms(Home& home, const FurnitureShare& share, Random& random) {
  int item = home.boxes.empty() ? 0 : home.boxes.back().item + 1;
  double num_due = 0;
  for (const HomeRoom& room : home.rooms) {
    num_due += share.of_rooms;
    if (num_due < 1) continue;
    num_due -= 1;
    RoomBlocks blocks = BlocksOf(home, room);
    for (const FurniturePiece& piece : FurnitureFor(room.use, random)) {
      if (!random.Chance(share.of_pieces)) continue;
      if (TryPlacePiece(home, room, piece, item, blocks, random)) ++item;
    }
  }
}

bool HangMirror(Home& home, Random& random) {
  constexpr double kThickness_m = 0.02;
  FurniturePiece mirror;
  mirror.footprint = {random.Millimetres(0.6, 1.8), kThickness_m};
  mirror.is_tall = true;
  HomeBox glass;
  glass.center = {0, 0.5 * kThickness_m};
  glass.size = mirror.footprint;
  glass.z0 = random.Millimetres(0.1, 0.9);
  glass.z1 = random.Millimetres(1.8, 2.1);
  glass.finish = Finish::kMirror;
  glass.rgb = {0.03f, 0.03f, 0.03f};
  mirror.boxes = {glass};
  for (int tries = 0; tries < 20; ++tries) {
    const auto room_idx = static_cast<size_t>(random.Index(static_cast<int>(home.rooms.size())));
    const HomeRoom& room = home.rooms[room_idx];
    if (room.use == RoomUse::kCloset) continue;
    RoomBlocks blocks = BlocksOf(home, room);
    if (TryPlacePiece(home, room, mirror, 0, blocks, random)) return true;
  }
  return false;
}

double Clearance(const Home& home, int room_id, const Vector2d& p) {
  const HomeRoom& room = home.RoomById(room_id);
  if (!Contains(room.polygon, p)) return -1;
  double nearest = std::numeric_limits<double>::infinity();
  const auto add_ring = [&](const Ring2& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      nearest = std::min(nearest, DistanceToSegment(p, ring[i], ring[(i + 1) % ring.size()]));
    }
  };
  const auto add_box = [&](const HomeBox& box) {
    const Ring2 ring = box.Footprint();
    if (Contains(ring, p)) nearest = -1;
    add_ring(ring);
  };
  for (const Ring2& ring : RingsOf(room.polygon)) add_ring(ring);
  for (const HomeBox& box : home.boxes) {
    if (box.room_id == room_id) add_box(box);
  }
  for (const HomeOpening& opening : home.openings) {
    if (opening.leaf == DoorLeaf::kOpen) add_box(OpenLeaf(opening));
  }
  return nearest;
}

void AddCamera(Home& home, int room_id, const Eigen::Vector3d& position, double azimuth_rad) {
  HomeCamera camera;
  const std::string number = std::to_string(home.cameras.size());
  camera.picture =
      "pano_" + std::string(3 - std::min<size_t>(number.size(), 3), '0') + number + ".jpg";
  camera.room_id = room_id;
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  camera.home_from_cam.rotation.col(0) = Eigen::Vector3d(s, -c, 0);
  camera.home_from_cam.rotation.col(1) = Eigen::Vector3d(0, 0, -1);
  camera.home_from_cam.rotation.col(2) = Eigen::Vector3d(c, s, 0);
  camera.home_from_cam.translation = position;
  home.cameras.push_back(camera);
}

void HangLamps(Home& home, const std::vector<float>& radiance) {
  constexpr double kHang_m = 0.07;
  for (size_t i = 0; i < home.rooms.size(); ++i) {
    const HomeRoom& room = home.rooms[i];
    const Vector2d p = InnermostPlace(room.polygon);
    HomeLamp lamp;
    lamp.room_id = room.id;
    lamp.center = {p.x(), p.y(), room.ceiling_z - kHang_m};
    lamp.radiance = radiance[i] * Eigen::Vector3f(1.0f, 0.86f, 0.70f);
    home.lamps.push_back(lamp);
  }
}

bool PlaceTourCameras(Home& home, Random& random) {
  const double height_m = random.Millimetres(1.3, 1.65);
  const int wanted = 8 + random.Index(5);
  std::vector<RoomCameras> rooms;
  for (const HomeRoom& room : home.rooms) {
    if (room.use == RoomUse::kCloset) continue;
    rooms.push_back({&room, {}, false});
    if (!AddPlace(home, rooms.back(), random)) return false;
  }
  int total = static_cast<int>(rooms.size());
  while (total < wanted) {
    const auto floor_for_next = [](const RoomCameras& r) {
      return r.is_full ? 0.0 : Area(r.room->polygon) / static_cast<double>(r.places.size() + 1);
    };
    const auto next = std::max_element(
        rooms.begin(), rooms.end(),
        [&](const auto& a, const auto& b) { return floor_for_next(a) < floor_for_next(b); });
    if (next->is_full) break;
    if (AddPlace(home, *next, random)) ++total;
  }
  if (total < 8) return false;
  for (const RoomCameras& room : rooms) AddCameras(home, room, height_m, 0.02, random);
  return true;
}

bool PlaceCameras(Home& home, Random& random) {
  const double height_m = random.Millimetres(1.3, 1.6);
  for (const HomeRoom& room : home.rooms) {
    const int wanted = home.rooms.size() == 1 || Area(room.polygon) > kTwoCamerasArea_m2 ? 2 : 1;
    RoomCameras cameras{&room, {}, false};
    while (static_cast<int>(cameras.places.size()) < wanted && !cameras.is_full) {
      (void)AddPlace(home, cameras, random);
    }
    if (cameras.places.empty()) return false;
    AddCameras(home, cameras, height_m, 0.01, random);
  }
  return true;
}

}  // namespace enfilade
