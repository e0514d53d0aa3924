// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/wall_fitter.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "src/synthetic/outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kGap_m = 0.05;
constexpr double kHandle_m = 0.03;  // handles reach this far out of a piece's footprint
constexpr double kWindowReach_m = 0.3;
// Nothing goes into the gap between a cupboard and its wall.
constexpr double kLeastDepth_m = 0.12;
constexpr double kHeadroom_m = 1.9;
// Cameras keep more distance from what juts out than from a plate on the wall.
constexpr double kThin_m = 0.05, kReachToThin_m = 0.32, kReach_m = 0.55;

std::pair<double, double> HeightsOf(const FurniturePiece& piece, double floor_z) {
  double low = piece.boxes.front().z0, high = piece.boxes.front().z1;
  for (const HomeBox& box : piece.boxes) {
    low = std::min(low, box.z0);
    high = std::max(high, box.z1);
  }
  return {floor_z + low, floor_z + high};
}

}  // namespace

WallFitter::WallFitter(Home& home, const HomeRoom& room) : home_(home), room_(room) {
  const std::vector<HomeWall> all = HomeWalls(home);
  std::copy_if(all.begin(), all.end(), std::back_inserter(walls_),
               [&](const HomeWall& wall) { return wall.room_id == room.id; });
  for (const HomeOpening& opening : home.openings) {
    if (opening.kind != OpeningKind::kWindow) continue;
    for (const HomeWall& wall : walls_) {
      const auto on = OpeningOnWall(opening, wall);
      if (!on) continue;
      const Vector2d a = wall.a + on->first * wall.Along(), b = wall.a + on->second * wall.Along();
      const Vector2d in = kWindowReach_m * wall.Inward();
      windows_.push_back({{a, b, b + in, a + in}, opening.sill_z, opening.head_z});
    }
  }
}

bool WallFitter::IsClearOfOpenings(const Ring2& ring, std::pair<double, double> z,
                                   BeforeWindows before_windows) const {
  for (const HomeOpening& opening : home_.openings) {
    if (opening.kind == OpeningKind::kWindow || z.first >= opening.head_z + 2 * kGap_m) continue;
    for (const Ring2& part : DoorClearance(opening)) {
      if (DoConvexOverlap(part, ring)) return false;
    }
  }
  if (before_windows == BeforeWindows::kAllowed) return true;
  return std::none_of(windows_.begin(), windows_.end(), [&](const WindowHole& window) {
    return z.first < window.head_z + kGap_m && z.second > window.sill_z - kGap_m &&
           DoConvexOverlap(window.before, ring);
  });
}

bool WallFitter::IsClearOfThings(const Ring2& ring, std::pair<double, double> z) const {
  return std::none_of(home_.boxes.begin(), home_.boxes.end(), [&](const HomeBox& box) {
    return box.room_id == room_.id && z.first < box.z1 && z.second > box.z0 &&
           DoConvexOverlap(box.Footprint(), ring);
  });
}

bool WallFitter::IsClearOfCameras(const Ring2& ring, double reach_m) const {
  return std::none_of(home_.cameras.begin(), home_.cameras.end(), [&](const HomeCamera& camera) {
    const Vector2d p = camera.home_from_cam.translation.head<2>();
    return camera.room_id == room_.id && (Contains(ring, p) || DistanceToRing(ring, p) < reach_m);
  });
}

bool WallFitter::FixAt(const HomeWall& wall, double middle_m, const FurniturePiece& piece,
                       BeforeWindows before_windows) {
  const PieceStand stand{wall.a + middle_m * wall.Along(),
                         std::atan2(wall.Along().y(), wall.Along().x())};
  const std::pair<double, double> z = HeightsOf(piece, room_.floor_z);
  FurniturePiece deep = piece;
  deep.footprint.y() = std::max(piece.footprint.y(), kLeastDepth_m);
  const Ring2 ring = PieceFootprint(piece, stand, 0);
  const bool is_thin = piece.footprint.y() < kThin_m;
  const bool is_overhead = z.first - room_.floor_z >= kHeadroom_m;
  if (!IsConvexInside(ring, room_.polygon) ||
      !IsClearOfOpenings(PieceFootprint(piece, stand, kHandle_m), z, before_windows) ||
      !IsClearOfThings(PieceFootprint(deep, stand, kGap_m), z) ||
      (!is_overhead && !IsClearOfCameras(ring, is_thin ? kReachToThin_m : kReach_m))) {
    return false;
  }
  const size_t first = home_.boxes.size();
  AddPiece(home_, room_, piece, stand);
  for (size_t i = first; i < home_.boxes.size(); ++i) {
    home_.boxes[i].is_built_in = true;
    // What reaches the ceiling must not pass it by a rounding error.
    home_.boxes[i].z1 = std::min(home_.boxes[i].z1, room_.ceiling_z);
  }
  return true;
}

bool WallFitter::FixSomewhere(const FurniturePiece& piece, Random& random) {
  constexpr int kTries = 40;
  const double half_m = 0.5 * piece.footprint.x();
  for (int tries = 0; tries < kTries; ++tries) {
    const HomeWall& wall = random.Pick(walls_);
    const double length_m = (wall.b - wall.a).norm(), slack_m = length_m - 2 * half_m;
    if (slack_m < 0) continue;
    const double share = random.Chance(0.5) ? random.Uniform() : random.Index(2);
    if (FixAt(wall, half_m + share * slack_m, piece)) return true;
  }
  return false;
}

}  // namespace enfilade
