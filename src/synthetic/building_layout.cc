// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "src/synthetic/rectangle.h"
#include "src/synthetic/room_row.h"
#include "src/synthetic/rooms.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kMaxPerWing = 25;  // rooms, the corridor among them

double CorridorWidth(Random& random) { return random.Millimetres(1.6, 2.2); }

// How many of `total` things the group `idx` of `num_groups` gets, as evenly as can be.
int ShareOf(int total, int num_groups, int idx) {
  return total / num_groups + (idx < total % num_groups ? 1 : 0);
}

// A corridor with a row of rooms on either side.
struct Wing {
  std::vector<Rectangle> rooms;
  Rectangle corridor;
  double top = 0;
};

std::optional<Wing> MakeWing(const Vector2d& low, double length_m, int num_below, int num_above,
                             Random& random) {
  const double below_m = random.Millimetres(3.0, 4.6), above_m = random.Millimetres(3.0, 4.6);
  const double corridor_y = low.y() + below_m + InnerThickness(random);
  const double corridor_top = corridor_y + CorridorWidth(random);
  const double above_y = corridor_top + InnerThickness(random);
  const auto below = DivideRow(low, length_m, below_m, num_below, random);
  const auto above = DivideRow({low.x(), above_y}, length_m, above_m, num_above, random);
  if (!below || !above) return std::nullopt;
  Wing wing{*below, {{low.x(), corridor_y}, {low.x() + length_m, corridor_top}}, above_y + above_m};
  wing.rooms.insert(wing.rooms.end(), above->begin(), above->end());
  return wing;
}

}  // namespace

std::optional<RoomLayout> MakeBuildingLayout(int num_rooms, Random& random) {
  const int num_wings = (num_rooms + kMaxPerWing - 1) / kMaxPerWing;
  const bool has_spine = num_wings > 1;
  const int num_main = num_rooms - num_wings - static_cast<int>(has_spine);
  const int num_rows = 2 * num_wings;
  const double length_m = ShareOf(num_main, num_rows, 0) * random.Millimetres(3.5, 4.0);
  const double spine_m = CorridorWidth(random);
  Vector2d low(has_spine ? spine_m + InnerThickness(random) : 0, 0);

  RoomLayout layout;
  layout.max_wall_thickness_m = 0.20;
  std::vector<Rectangle> corridors;
  for (int i = 0; i < num_wings; ++i) {
    const auto wing = MakeWing(low, length_m, ShareOf(num_main, num_rows, 2 * i),
                               ShareOf(num_main, num_rows, 2 * i + 1), random);
    if (!wing) return std::nullopt;
    for (const Rectangle& room : wing->rooms) layout.rooms.push_back({RingOf(room)});
    corridors.push_back(wing->corridor);
    layout.max = {low.x() + length_m, wing->top};
    low.y() = wing->top + InnerThickness(random);
  }
  if (has_spine) corridors.push_back({{0, 0}, {spine_m, layout.max.y()}});
  // Leaves open into the room that comes first: corridors last.
  for (const Rectangle& corridor : corridors)
    layout.rooms.push_back({RingOf(corridor), RoomUse::kHall});
  return layout;
}

}  // namespace enfilade
