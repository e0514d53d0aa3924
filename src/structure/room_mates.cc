// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/room_mates.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

// Samples of a panorama's floor: every so many columns, so many along each.
constexpr int kColumnStep = 16;
constexpr int kRadii = 8;
// Through an open door less than the first share of a room's floor is seen, and within a room
// without corners more than the second.
constexpr double kThroughDoor = 0.3, kInRoom = 0.7;

struct Floor {
  Eigen::Vector2d position{0, 0};
  const KnownDistances& wall_m;
};

// Share of the floor before the walls of one panorama that lies before the walls of another.
double ShareSeen(const Floor& of, const Floor& by) {
  const int num_columns = static_cast<int>(of.wall_m.size());
  double seen = 0, total = 0;
  for (int c = 0; c < num_columns; c += kColumnStep) {
    const double azimuth = AzimuthOfColumn(c, num_columns);
    const double wall_m = of.wall_m[static_cast<size_t>(c)];
    for (int k = 0; k < kRadii; ++k) {
      const double range = wall_m * (k + 0.5) / kRadii;
      const Eigen::Vector2d ray =
          of.position + range * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)) - by.position;
      const double area = wall_m * range;
      total += area;
      if (ray.norm() < DistanceTowards(by.wall_m, ray)) seen += area;
    }
  }
  return seen / total;
}

}  // namespace

std::vector<std::vector<RoomMate>> FindRoomMates(std::span<const Eigen::Vector2d> positions,
                                                 std::span<const KnownDistances> walls) {
  ENFILADE_CHECK(positions.size() == walls.size());
  std::vector<std::vector<RoomMate>> mates(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    const Floor own{positions[i], walls[i]};
    for (size_t j = 0; j < i; ++j) {
      const Floor other{positions[j], walls[j]};
      const double share = std::min(ShareSeen(own, other), ShareSeen(other, own));
      const double weight = std::min(1.0, (share - kThroughDoor) / (kInRoom - kThroughDoor));
      if (weight <= 0) continue;
      mates[i].push_back({static_cast<int>(j), weight});
      mates[j].push_back({static_cast<int>(i), weight});
    }
  }
  return mates;
}

}  // namespace enfilade
