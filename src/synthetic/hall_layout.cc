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

constexpr double kMinArm_m = 1.7;

// A piece cut out of the top side of a rectangle, from `begin` to `end` along x.
struct Notch {
  double begin, end, depth;
};

// The rest of the rectangle, counter-clockwise; notches from left to right.
Ring2 RingWithNotches(const Rectangle& r, const std::vector<Notch>& notches) {
  Ring2 ring = {r.min, {r.max.x(), r.min.y()}};
  double right = r.max.x();
  for (auto notch = notches.rbegin(); notch != notches.rend(); ++notch) {
    const double low = r.max.y() - notch->depth;
    if (notch->end < right) {
      ring.emplace_back(right, r.max.y());
      ring.emplace_back(notch->end, r.max.y());
    }
    ring.emplace_back(notch->end, low);
    ring.emplace_back(notch->begin, low);
    right = notch->begin;
  }
  if (right > r.min.x()) {
    ring.emplace_back(right, r.max.y());
    ring.emplace_back(r.min.x(), r.max.y());
  }
  return ring;
}

// The hall, in the left part of `strip`, and the room at its end, which takes the rest of the
// strip: at the room's full width, or as an L.
bool AddHall(const Rectangle& strip, const Rectangle& end_room, double wall_below_m,
             std::vector<RoomShape>& out, Random& random) {
  const double wall_m = InnerThickness(random), left = end_room.min.x();
  double hall_end = left - wall_m;
  std::vector<Notch> notches;
  if (end_room.Size().x() > 2 * kMinArm_m + 0.2 && random.Chance(0.6)) {
    hall_end = left + random.Millimetres(0.8, end_room.Size().x() - kMinArm_m - wall_m);
    notches.push_back({left, hall_end + wall_m, strip.Size().y() + wall_below_m});
  }
  if (hall_end - strip.min.x() < 2.5) return false;
  out.push_back({RingWithNotches(end_room, notches), RoomUse::kLiving});
  out.push_back({RingOf({strip.min, {hall_end, strip.max.y()}}), RoomUse::kHall});
  return true;
}

// Cuts closets out of the top side of a room: one in a corner or in the middle, two in the corners.
bool CutClosets(const Rectangle& room, int count, std::vector<RoomShape>& out, Random& random) {
  std::vector<Notch> notches;
  std::vector<RoomShape> closets;
  const double depth_m = random.Millimetres(0.75, 1.1);
  const double width_m = room.Size().x(), left = room.min.x(), right = room.max.x();
  if (room.Size().y() - depth_m - 0.2 < kMinArm_m) return false;
  double free_m = width_m;
  const int place = count == 2 ? 0 : random.Index(3);
  for (int i = 0; i < count; ++i) {
    const double closet_m = random.Millimetres(1.25, 1.7), wall_m = InnerThickness(random);
    const double top = room.max.y();
    Notch notch{left, left + closet_m + wall_m, depth_m + wall_m};
    Rectangle closet{{left, top - depth_m}, {left + closet_m, top}};
    if (i == 1 || place == 1) {
      notch = {right - closet_m - wall_m, right, depth_m + wall_m};
      closet = {{right - closet_m, top - depth_m}, {right, top}};
    } else if (place == 2) {
      const double begin = left + std::round(500 * (width_m - closet_m)) / 1000;
      notch = {begin - wall_m, begin + closet_m + wall_m, depth_m + wall_m};
      closet = {{begin, top - depth_m}, {begin + closet_m, top}};
    }
    free_m -= notch.end - notch.begin;
    notches.push_back(notch);
    closets.push_back({RingOf(closet), RoomUse::kCloset});
  }
  if (free_m < (place == 2 ? 2.4 : 1.2)) return false;
  out.push_back({RingWithNotches(room, notches)});
  out.insert(out.end(), closets.begin(), closets.end());
  return true;
}

}  // namespace

std::optional<RoomLayout> MakeHallLayout(int num_rooms, Random& random) {
  const int num_closets = num_rooms < 6 ? 0 : 1 + static_cast<int>(random.Chance(0.5));
  const int num_main = num_rooms - 1 - num_closets;
  const int num_lower = num_main / 2, num_upper = num_main - num_lower;
  const double below_m = InnerThickness(random), above_m = InnerThickness(random);
  const double hall_m = random.Millimetres(1.0, 1.5);
  const double lower_m = random.Millimetres(2.9, 4.4), upper_m = random.Millimetres(2.9, 4.2);
  const double length_m = num_upper * random.Millimetres(3.1, 4.3);
  const auto lower = DivideRow({0, 0}, length_m, lower_m, num_lower, random);
  const double hall_y = lower_m + below_m, upper_y = hall_y + hall_m + above_m;
  const auto upper = DivideRow({0, upper_y}, length_m, upper_m, num_upper, random);
  if (!lower || !upper) return std::nullopt;

  RoomLayout layout;
  layout.max = {length_m, upper_y + upper_m};
  layout.max_wall_thickness_m = 0.20;
  const Rectangle whole{{0, 0}, layout.max};

  for (int i = 0; i + 1 < num_lower; ++i)
    layout.rooms.push_back({RingOf((*lower)[static_cast<size_t>(i)])});
  const int host = random.Index(num_upper);
  for (int i = 0; i < num_upper; ++i) {
    const Rectangle& room = (*upper)[static_cast<size_t>(i)];
    if (num_closets > 0 && i == host) {
      if (!CutClosets(room, num_closets, layout.rooms, random)) return std::nullopt;
    } else {
      layout.rooms.push_back({RingOf(room)});
    }
  }
  Rectangle last = lower->back();
  last.max.y() = hall_y + hall_m;
  // Leaves open into the room that comes first: closets follow theirs, the hall comes last.
  if (!AddHall({{0, hall_y}, last.max}, last, below_m, layout.rooms, random)) return std::nullopt;

  for (int axis : {0, 1}) {
    if (!random.Chance(0.5)) continue;
    for (RoomShape& room : layout.rooms) Mirror(room.ring, whole, axis);
  }
  return layout;
}

}  // namespace enfilade
