// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/openings.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "enfilade/geometry/cross.h"
#include "src/synthetic/outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kDoorHeight_m = 2.0;
constexpr double kCornerGap_m = 0.2;  // room for the door's frame
constexpr double kOpeningGap_m = 0.3;
constexpr double kOuterThickness_m = 0.28;

// A new opening on [begin_m, end_m] of the wall.
HomeOpening MakeOpening(const Home& home, const HomeWall& wall, double begin_m, double end_m) {
  HomeOpening opening;
  opening.id = static_cast<int>(home.openings.size());
  opening.a = wall.a + begin_m * wall.Along();
  opening.b = wall.a + end_m * wall.Along();
  opening.room_id = wall.room_id;
  const HomeRoom& room = home.RoomById(wall.room_id);
  opening.sill_z = room.floor_z;
  opening.head_z = room.floor_z + kDoorHeight_m;
  return opening;
}

// Whether [begin_m, end_m] of the wall keeps its distance from the openings that are there.
bool IsFree(const Home& home, const HomeWall& wall, double begin_m, double end_m) {
  return std::none_of(home.openings.begin(), home.openings.end(), [&](const HomeOpening& opening) {
    const auto taken = OpeningOnWall(opening, wall);
    return taken && taken->first < end_m + kOpeningGap_m && taken->second > begin_m - kOpeningGap_m;
  });
}

// How a door stands: without leaf, closed, or its leaf opened by an angle in a range.
struct DoorState {
  DoorLeaf leaf = DoorLeaf::kNone;
  double min_angle_rad = 0, max_angle_rad = 0;
};
constexpr DoorState kLeafless = {};
constexpr DoorState kOpen = {DoorLeaf::kOpen, 1.3, 1.75};
constexpr DoorState kAjar = {DoorLeaf::kOpen, 0.4, 0.9};
constexpr DoorState kClosed = {DoorLeaf::kClosed, 0, 0};
constexpr std::array<DoorState, 3> kPassable = {kLeafless, kOpen, kAjar};

bool AddDoor(Home& home, const SharedWall& shared, const DoorState& state, Random& random) {
  const double width_m = random.Millimetres(0.80, 0.90);
  const double slack_m = shared.end_m - shared.begin_m - width_m - 2 * kCornerGap_m;
  if (slack_m < 0) return false;
  const double begin_m = shared.begin_m + kCornerGap_m + random.Millimetres(0, slack_m);
  if (!IsFree(home, shared.wall, begin_m, begin_m + width_m)) return false;
  HomeOpening door = MakeOpening(home, shared.wall, begin_m, begin_m + width_m);
  door.other_room_id = shared.other_room_id;
  door.thickness_m = shared.thickness_m;
  door.leaf = state.leaf;
  door.leaf_angle_rad =
      state.leaf == DoorLeaf::kOpen ? random.Uniform(state.min_angle_rad, state.max_angle_rad) : 0;
  door.is_hinge_at_a = random.Chance(0.5);
  home.openings.push_back(door);
  return true;
}

template <typename T>
void Shuffle(std::vector<T>& values, Random& random) {
  for (size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[static_cast<size_t>(random.Index(static_cast<int>(i)))]);
  }
}

// Stretches of wall faces with no room behind them.
std::vector<SharedWall> FindOuterWalls(const Home& home, const std::vector<SharedWall>& shared) {
  std::vector<SharedWall> outer;
  for (const HomeWall& wall : HomeWalls(home)) {
    // Neighbours in front of this face, from either side of the pair.
    std::vector<std::pair<double, double>> taken;
    for (const SharedWall& s : shared) {
      const Vector2d from = s.wall.a + s.begin_m * s.wall.Along(),
                     to = s.wall.a + s.end_m * s.wall.Along();
      const bool is_same_line = std::abs(Cross(wall.Along(), s.wall.Along())) < 1e-9 &&
                                std::abs(wall.Inward().dot(from - wall.a)) < s.thickness_m + 1e-9;
      if (!is_same_line) continue;
      const double p = wall.Along().dot(from - wall.a), q = wall.Along().dot(to - wall.a);
      taken.emplace_back(std::min(p, q) - s.thickness_m, std::max(p, q) + s.thickness_m);
    }
    std::sort(taken.begin(), taken.end());
    double begin_m = 0;
    taken.emplace_back((wall.b - wall.a).norm(), 1e9);
    for (const auto& [from_m, to_m] : taken) {
      const double end_m = std::min(from_m, (wall.b - wall.a).norm());
      if (end_m - begin_m > 1.0) outer.push_back({wall, -1, begin_m, end_m, kOuterThickness_m});
      begin_m = std::max(begin_m, to_m);
    }
  }
  return outer;
}

// Whether a ray could meet what lies in the bounds.
bool MayMeet(const Rectangle& bounds, const Vector2d& from, const Vector2d& direction) {
  constexpr double kTolerance_m = 1e-6;
  const Vector2d center = bounds.Center() - from, half = 0.5 * bounds.Size(),
                 reach = direction.cwiseAbs();
  return center.dot(direction) + half.dot(reach) > -kTolerance_m &&
         std::abs(Cross(center, direction)) <
             half.x() * reach.y() + half.y() * reach.x() + kTolerance_m;
}

// Only stretches with open country behind them: the way out must not pass another room.
bool LooksOutside(const Home& home, const std::vector<Rectangle>& bounds,
                  const SharedWall& stretch) {
  const Vector2d out = -stretch.wall.Inward();
  for (double t : {0.02, 0.5, 0.98}) {
    const Vector2d from =
        stretch.wall.a + 1e-6 * out +
        (stretch.begin_m + t * (stretch.end_m - stretch.begin_m)) * stretch.wall.Along();
    for (size_t i = 0; i < home.rooms.size(); ++i) {
      if (MayMeet(bounds[i], from, out) &&
          std::isfinite(RayDistance(home.rooms[i].polygon.outer, from, out)))
        return false;
    }
  }
  return true;
}

HomeOpening* RandomWindow(Home& home, Random& random) {
  std::vector<HomeOpening*> windows;
  for (HomeOpening& opening : home.openings) {
    if (opening.kind == OpeningKind::kWindow && !opening.other_room_id) windows.push_back(&opening);
  }
  if (windows.empty()) return nullptr;
  return random.Pick(windows);
}

bool IsCloset(const HomeRoom& room) { return room.use == RoomUse::kCloset; }

bool IsPrivate(const HomeRoom& room) {
  return IsCloset(room) || room.use == RoomUse::kBedroom || room.use == RoomUse::kBath;
}

// A free part of the wall between two rooms.
struct WallSpan {
  SharedWall shared;
  double begin_m = 0, end_m = 0;
};

std::optional<WallSpan> FindSpan(const Home& home, double max_thickness_m, double min_width_m,
                                 double max_width_m, bool (*is_out)(const HomeRoom&),
                                 Random& random) {
  constexpr int kTries = 20;
  std::vector<SharedWall> shared =
      FindSharedWalls(home, max_thickness_m, min_width_m + 2 * kCornerGap_m);
  std::erase_if(shared, [&](const SharedWall& s) {
    return is_out(home.RoomById(s.wall.room_id)) || is_out(home.RoomById(s.other_room_id));
  });
  for (int tries = 0; tries < kTries && !shared.empty(); ++tries) {
    const SharedWall& s = random.Pick(shared);
    const double free_m = s.end_m - s.begin_m - 2 * kCornerGap_m;
    const double width_m = random.Millimetres(min_width_m, std::min(free_m, max_width_m));
    const double begin_m = s.begin_m + kCornerGap_m + random.Millimetres(0, free_m - width_m);
    if (IsFree(home, s.wall, begin_m, begin_m + width_m))
      return WallSpan{s, begin_m, begin_m + width_m};
  }
  return std::nullopt;
}

bool AddEntrance(Home& home, Random& random) {
  std::vector<SharedWall> stretches = OuterStretches(home);
  Shuffle(stretches, random);
  for (const SharedWall& stretch : stretches) {
    if (!AddDoor(home, stretch, kClosed, random)) continue;
    home.openings.back().other_room_id = std::nullopt;
    return true;
  }
  return false;
}

}  // namespace

std::vector<HomeWall> WallsOf(const HomeRoom& room, int first_id) {
  std::vector<HomeWall> walls;
  for (const Ring2& ring : RingsOf(room.polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      walls.push_back({first_id + static_cast<int>(walls.size()), room.id, ring[i],
                       ring[(i + 1) % ring.size()]});
    }
  }
  return walls;
}

HomeRoom& RoomOf(Home& home, const HomeWall& wall) {
  return *std::find_if(home.rooms.begin(), home.rooms.end(),
                       [&](const HomeRoom& room) { return room.id == wall.room_id; });
}

std::vector<SharedWall> FindSharedWalls(const Home& home, double max_thickness_m,
                                        double min_length_m) {
  std::vector<SharedWall> shared;
  const std::vector<HomeWall> walls = HomeWalls(home);
  for (const HomeWall& wall : walls) {
    for (const HomeWall& other : walls) {
      if (other.room_id <= wall.room_id || wall.Along().dot(other.Along()) > -1 + 1e-9) continue;
      const double thickness_m = -wall.Inward().dot(other.a - wall.a);
      if (thickness_m < 1e-6 || thickness_m > max_thickness_m) continue;
      // The other face runs the opposite way.
      const double begin_m = std::max(0.0, wall.Along().dot(other.b - wall.a));
      const double end_m = std::min((wall.b - wall.a).norm(), wall.Along().dot(other.a - wall.a));
      if (end_m - begin_m >= min_length_m &&
          home.IsOnStorey(other.room_id, home.RoomById(wall.room_id).storey_idx)) {
        shared.push_back({wall, other.room_id, begin_m, end_m, thickness_m});
      }
    }
  }
  return shared;
}

std::vector<SharedWall> OuterStretches(const Home& home) {
  std::vector<SharedWall> stretches = FindOuterWalls(home, FindSharedWalls(home, 0.5, 0.05));
  std::vector<Rectangle> bounds;
  for (const HomeRoom& room : home.rooms) bounds.push_back(BoundsOf(room.polygon.outer));
  std::erase_if(stretches, [&](const SharedWall& s) { return !LooksOutside(home, bounds, s); });
  return stretches;
}

bool AddDoors(Home& home, double max_thickness_m, const DoorMix& mix, Random& random) {
  std::vector<SharedWall> shared = FindSharedWalls(home, max_thickness_m, 1.25);
  Shuffle(shared, random);
  std::vector<int> group(home.rooms.size());
  std::iota(group.begin(), group.end(), 0);
  const auto join = [&](int room_id, int other_room_id) {
    const int from = group[static_cast<size_t>(room_id)];
    const int to = group[static_cast<size_t>(other_room_id)];
    std::replace(group.begin(), group.end(), to, from);
  };
  for (const HomeOpening& opening : home.openings) join(opening.room_id, *opening.other_room_id);
  const auto leads_to_closet = [&](const SharedWall& s) {
    return IsCloset(home.RoomById(s.wall.room_id)) || IsCloset(home.RoomById(s.other_room_id));
  };
  bool is_ajar_due = mix.has_ajar;
  bool has_leaf = mix.has_ajar;  // the open plan may leave but two doors, one of them ajar
  std::vector<SharedWall> rest;
  for (const SharedWall& s : shared) {
    const auto room_idx = static_cast<size_t>(s.wall.room_id);
    const bool is_ajar = is_ajar_due && leads_to_closet(s);
    const DoorState& state = is_ajar ? kAjar : has_leaf ? kOpen : kLeafless;
    if (group[room_idx] == group[static_cast<size_t>(s.other_room_id)]) {
      rest.push_back(s);
    } else if (AddDoor(home, s, state, random)) {
      join(s.wall.room_id, s.other_room_id);
      if (is_ajar) {
        is_ajar_due = false;
      } else {
        has_leaf = !has_leaf;
      }
    }
  }
  if (std::any_of(group.begin(), group.end(), [&](int g) { return g != group[0]; })) return false;
  for (const SharedWall& s : rest) {
    if (is_ajar_due && AddDoor(home, s, kAjar, random)) {
      is_ajar_due = false;
    } else if (random.Chance(mix.closed_inner_share)) {
      (void)AddDoor(home, s, kClosed, random);
    } else if (mix.open_inner_share > 0 && random.Chance(mix.open_inner_share)) {
      (void)AddDoor(home, s, kOpen, random);
    }
  }
  return !is_ajar_due && AddEntrance(home, random);
}

bool AddCorridorDoors(Home& home, double max_thickness_m, Random& random) {
  std::vector<SharedWall> shared = FindSharedWalls(home, max_thickness_m, 1.25);
  Shuffle(shared, random);
  std::vector<char> is_joined(home.rooms.size(), 0);
  size_t num_doors = 0;
  for (const SharedWall& s : shared) {
    const bool is_hall = home.RoomById(s.wall.room_id).use == RoomUse::kHall;
    if (home.RoomById(s.other_room_id).use != RoomUse::kHall) continue;  // corridors come last
    char& is_room_joined = is_joined[static_cast<size_t>(s.wall.room_id)];
    if (!is_hall && is_room_joined != 0) continue;
    const DoorState& state = is_hall ? kLeafless : kPassable[num_doors % kPassable.size()];
    if (!AddDoor(home, s, state, random)) continue;
    is_room_joined = 1;
    ++num_doors;
  }
  // Nothing comes after the last corridor; it is joined to the others by doors of theirs.
  if (std::find(is_joined.begin(), is_joined.end() - 1, 0) != is_joined.end() - 1) return false;
  return AddEntrance(home, random);
}

bool AddWindows(Home& home, Random& random) {
  std::vector<SharedWall> stretches = OuterStretches(home);
  Shuffle(stretches, random);
  std::vector<int> num_windows(home.rooms.size(), 0);
  std::vector<int> wanted(home.rooms.size());
  for (int& w : wanted) w = random.Chance(0.92) ? 1 + static_cast<int>(random.Chance(0.4)) : 0;
  for (const SharedWall& s : stretches) {
    const auto room_idx = static_cast<size_t>(s.wall.room_id);
    const double length_m = s.end_m - s.begin_m;
    const double width_m = random.Millimetres(0.8, std::clamp(length_m - 0.6, 0.8, 1.9));
    const double slack_m = length_m - width_m - 0.6;
    if (num_windows[room_idx] >= wanted[room_idx] || slack_m < 0) continue;
    const double begin_m = s.begin_m + 0.3 + random.Millimetres(0, slack_m);
    if (!IsFree(home, s.wall, begin_m, begin_m + width_m)) continue;
    HomeOpening window = MakeOpening(home, s.wall, begin_m, begin_m + width_m);
    const HomeRoom& room = home.rooms[room_idx];
    window.kind = OpeningKind::kWindow;
    window.thickness_m = s.thickness_m;
    window.sill_z = room.floor_z + random.Millimetres(0.80, 1.05);
    window.head_z = std::min(room.floor_z + random.Millimetres(2.0, 2.25), room.ceiling_z - 0.12);
    home.openings.push_back(window);
    ++num_windows[room_idx];
  }
  return std::any_of(num_windows.begin(), num_windows.end(), [](int n) { return n > 0; });
}

void LowerAWindow(Home& home, Random& random) {
  HomeOpening* window = RandomWindow(home, random);
  if (window == nullptr) return;
  window->sill_z = home.RoomById(window->room_id).floor_z + random.Millimetres(0.15, 0.35);
}

void GlazeADoor(Home& home, Random& random) {
  HomeOpening* window = RandomWindow(home, random);
  if (window == nullptr) return;
  window->sill_z = home.RoomById(window->room_id).floor_z + 0.03;
}

bool AddWideOpening(Home& home, double max_thickness_m, Random& random) {
  constexpr double kMinWidth_m = 1.6, kMaxWidth_m = 3.2;
  const std::optional<WallSpan> span =
      FindSpan(home, max_thickness_m, kMinWidth_m, kMaxWidth_m, IsPrivate, random);
  if (!span) return false;
  const double lowest = std::min(home.RoomById(span->shared.wall.room_id).ceiling_z,
                                 home.RoomById(span->shared.other_room_id).ceiling_z);
  HomeOpening opening = MakeOpening(home, span->shared.wall, span->begin_m, span->end_m);
  opening.kind = OpeningKind::kOpening;
  opening.other_room_id = span->shared.other_room_id;
  opening.thickness_m = span->shared.thickness_m;
  opening.head_z = lowest - random.Millimetres(0.05, 0.3);
  home.openings.push_back(opening);
  return true;
}

bool AddGlassWall(Home& home, double max_thickness_m, Random& random) {
  constexpr double kMinWidth_m = 1.2, kMaxWidth_m = 2.4;
  const std::optional<WallSpan> span =
      FindSpan(home, max_thickness_m, kMinWidth_m, kMaxWidth_m, IsCloset, random);
  if (!span) return false;
  HomeOpening glass = MakeOpening(home, span->shared.wall, span->begin_m, span->end_m);
  glass.kind = OpeningKind::kWindow;
  glass.other_room_id = span->shared.other_room_id;
  glass.thickness_m = span->shared.thickness_m;
  glass.sill_z += 0.03;
  home.openings.push_back(glass);
  return true;
}

}  // namespace enfilade
