// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/truth.h"
#include "src/synthetic/built_ins.h"
#include "src/synthetic/openings.h"
#include "src/synthetic/outline.h"

namespace enfilade {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;

constexpr double kWallGap_m = 0.025;  // clear of the baseboard
constexpr double kItemGap_m = 0.08;
constexpr double kDoorDepth_m = 0.9;
constexpr double kLeafThickness_m = 0.04;
constexpr double kCameraReach_m = 0.5;  // floor that pieces leave round a camera that is there

bool IsInAny(const std::vector<Ring2>& blocks, const Ring2& ring) {
  return std::any_of(blocks.begin(), blocks.end(),
                     [&](const Ring2& block) { return DoConvexOverlap(block, ring); });
}

Ring2 RectangleRing(const Vector2d& low, const Vector2d& high, const Vector2d& origin,
                    double yaw_rad) {
  const Rotation2Dd turn(yaw_rad);
  return {origin + turn * low, origin + turn * Vector2d(high.x(), low.y()), origin + turn * high,
          origin + turn * Vector2d(low.x(), high.y())};
}

// The region of a room that furniture must leave free.
struct RoomBlocks {
  std::vector<Ring2> everywhere;  ///< doors, furniture that is there
  std::vector<Ring2> windows;     ///< in front of windows: low pieces only
};

RoomBlocks BlocksOf(const Home& home, const HomeRoom& room) {
  RoomBlocks blocks;
  for (const HomeBox& box : home.boxes) {
    if (box.room_id == room.id) blocks.everywhere.push_back(box.Footprint());
  }
  for (const HomeCamera& camera : home.cameras) {
    const Vector2d reach(kCameraReach_m, kCameraReach_m);
    const Vector2d place = camera.home_from_cam.translation.head<2>();
    blocks.everywhere.push_back(RectangleRing(-reach, reach, place, 0));
  }
  for (const HomeOpening& opening : home.openings) {
    if (opening.kind == OpeningKind::kWindow) {
      const Vector2d in = -0.6 * opening.IntoWall();
      if (opening.room_id == room.id) {
        blocks.windows.push_back({opening.b, opening.b + in, opening.a + in, opening.a});
      }
    } else {
      for (Ring2& part : DoorClearance(opening)) blocks.everywhere.push_back(std::move(part));
    }
  }
  // What is in nobody's way here: most doors of a large building.
  const Rectangle bounds = BoundsOf(room.polygon.outer);
  std::erase_if(blocks.everywhere, [&](const Ring2& block) {
    return !AreNear(BoundsOf(block), bounds, 2 * kItemGap_m);
  });
  return blocks;
}

PieceStand RandomStand(const HomeRoom& room, const FurniturePiece& piece, Random& random) {
  const std::vector<HomeWall> walls = WallsOf(room);
  const HomeWall& wall = random.Pick(walls);
  const double yaw_rad = std::atan2(wall.Along().y(), wall.Along().x());
  const double along_m = random.Millimetres(0, (wall.b - wall.a).norm());
  const double off_m = piece.is_against_wall ? kWallGap_m : random.Millimetres(0.3, 2.0);
  return {wall.a + along_m * wall.Along() + off_m * wall.Inward(), yaw_rad};
}

bool TryPlacePiece(Home& home, const HomeRoom& room, const FurniturePiece& piece,
                   RoomBlocks& blocks, Random& random) {
  constexpr int kTries = 60;
  for (int i = 0; i < kTries; ++i) {
    const PieceStand stand = RandomStand(room, piece, random);
    const Ring2 footprint = PieceFootprint(piece, stand, 0);
    if (!IsConvexInside(footprint, room.polygon)) continue;
    const Ring2 wide = PieceFootprint(piece, stand, kItemGap_m);
    if (IsInAny(blocks.everywhere, wide) || (piece.is_tall && IsInAny(blocks.windows, wide)))
      continue;
    AddPiece(home, room, piece, stand);
    blocks.everywhere.push_back(footprint);
    return true;
  }
  return false;
}

// Each piece with a chance of `share`, in their order, where it fits; if that leaves the room
// empty, the least wanted one that fits, unless `share` is 0.
void PlacePieces(Home& home, const HomeRoom& room, const std::vector<FurniturePiece>& pieces,
                 double share, Random& random) {
  RoomBlocks blocks = BlocksOf(home, room);
  bool is_empty = true;
  for (const FurniturePiece& piece : pieces) {
    if (random.Chance(share)) is_empty &= !TryPlacePiece(home, room, piece, blocks, random);
  }
  for (size_t i = pieces.size(); i > 0 && is_empty && share > 0; --i)
    is_empty = !TryPlacePiece(home, room, pieces[i - 1], blocks, random);
}

// The place on a 10 cm grid that is farthest from the polygon's boundary.
Vector2d InnermostPlace(const Polygon2& polygon) {
  const Rectangle bounds = BoundsOf(polygon.outer);
  Vector2d best = bounds.min;
  double best_m = 0;
  for (double x = bounds.min.x() + 0.05; x < bounds.max.x(); x += 0.1) {
    for (double y = bounds.min.y() + 0.05; y < bounds.max.y(); y += 0.1) {
      if (!Contains(polygon, {x, y})) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Ring2& ring : RingsOf(polygon)) {
        nearest = std::min(nearest, DistanceToRing(ring, {x, y}));
      }
      if (nearest <= best_m + 1e-6) continue;
      best_m = nearest;
      best = {x, y};
    }
  }
  return best;
}

}  // namespace

Ring2 PieceFootprint(const FurniturePiece& piece, const PieceStand& stand, double margin_m) {
  const double half = 0.5 * piece.footprint.x() + margin_m;
  return RectangleRing({-half, -std::min(margin_m, 0.5 * kWallGap_m)},
                       {half, piece.footprint.y() + margin_m}, stand.origin, stand.yaw_rad);
}

void AddPiece(Home& home, const HomeRoom& room, const FurniturePiece& piece,
              const PieceStand& stand) {
  const int item = home.boxes.empty() ? 0 : home.boxes.back().item + 1;
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

std::vector<Ring2> DoorClearance(const HomeOpening& door) {
  const Vector2d along = 0.1 * (door.b - door.a).normalized(), out = door.IntoWall();
  const Vector2d back = -kDoorDepth_m * out, front = (door.thickness_m + kDoorDepth_m) * out;
  // a → b has the room on its left, so back lies left of it.
  std::vector<Ring2> parts = {{door.a - along + front, door.b + along + front,
                               door.b + along + back, door.a - along + back}};
  if (door.leaf == DoorLeaf::kOpen) parts.push_back(OpenLeaf(door).Footprint());
  return parts;
}

void FurnishRooms(Home& home, const FurnitureShare& share, Random& random) {
  double num_due = 0;
  for (const HomeRoom& room : home.rooms) {
    num_due += share.of_rooms;
    if (num_due < 1 || room.use == RoomUse::kHall || room.use == RoomUse::kCloset) continue;
    num_due -= 1;
    const bool is_fitted =
        std::any_of(home.boxes.begin(), home.boxes.end(),
                    [&](const HomeBox& box) { return box.is_built_in && box.room_id == room.id; });
    PlacePieces(home, room, FurnitureFor(room.use, is_fitted, random), share.of_pieces, random);
  }
}

bool BuildIn(Home& home, bool has_cabinets_to_ceiling, Random& random) {
  const size_t first = home.boxes.size();
  bool is_ceiling_reached = false;
  for (const HomeRoom& room : home.rooms) {
    PlacePieces(home, room, BuiltInsFor(room, has_cabinets_to_ceiling, random), 1, random);
  }
  for (size_t i = first; i < home.boxes.size(); ++i) {
    HomeBox& box = home.boxes[i];
    box.is_built_in = true;
    is_ceiling_reached |= box.z0 <= home.RoomById(box.room_id).floor_z &&
                          box.z1 >= home.RoomById(box.room_id).ceiling_z - 1e-9;
  }
  return is_ceiling_reached || !has_cabinets_to_ceiling;
}

bool HideFloorLine(Home& home, double min_share, Random& random) {
  constexpr int kPasses = 8;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (HiddenFloorLineShare(home) >= min_share) return true;
    FurnishRooms(home, {.of_pieces = 1, .of_rooms = 1}, random);
  }
  return HiddenFloorLineShare(home) >= min_share;
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
    const HomeRoom& room = random.Pick(home.rooms);
    if (room.use == RoomUse::kCloset) continue;
    RoomBlocks blocks = BlocksOf(home, room);
    if (TryPlacePiece(home, room, mirror, blocks, random)) return true;
  }
  return false;
}

void HangLamps(Home& home, const std::vector<float>& radiance) {
  constexpr double kHang_m = 0.07;
  for (size_t i = 0; i < home.rooms.size(); ++i) {
    const HomeRoom& room = home.rooms[i];
    const Vector2d p = InnermostPlace(room.polygon);
    HomeLamp lamp;
    lamp.room_id = room.id;
    const double slope_m = 0.5 * lamp.size.x() * room.ceiling_slope.norm();
    lamp.center = {p.x(), p.y(), room.CeilingAt(p) - kHang_m - slope_m};
    lamp.radiance = radiance[i] * Eigen::Vector3f(1.0f, 0.86f, 0.70f);
    home.lamps.push_back(lamp);
  }
}

void SpreadCorridorLamps(Home& home) {
  constexpr double kSpacing_m = 6;
  std::vector<HomeLamp> spread;
  for (HomeLamp lamp : home.lamps) {
    const HomeRoom& room = home.RoomById(lamp.room_id);
    const Ring2 places = room.use == RoomUse::kHall
                             ? PlacesAlong(BoundsOf(room.polygon.outer), kSpacing_m)
                             : Ring2{lamp.center.head<2>()};
    lamp.radiance /= static_cast<float>(places.size());
    for (const Vector2d& p : places) {
      lamp.center.head<2>() = p;
      spread.push_back(lamp);
    }
  }
  home.lamps = std::move(spread);
}

}  // namespace enfilade
