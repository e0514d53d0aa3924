// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/home.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/boolean.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

#ifdef __SANITIZE_ADDRESS__
constexpr int kSeeds = 100;
#else
constexpr int kSeeds = 1000;
#endif

Home Make(int seed, HomePreset preset, int storeys = 1) {
  HomeOptions options;
  options.seed = seed;
  options.preset = preset;
  options.storeys = storeys;
  return MakeHome(options);
}

// Valid; rooms do not overlap, so that their areas add up; cameras stand in their rooms or
// doorways.
void ExpectSoundPlan(const Home& home) {
  ASSERT_THAT(HomeProblems(home), IsEmpty());
  for (int storey_idx = 0; storey_idx < home.NumStoreys(); ++storey_idx) {
    MultiPolygon2 rooms;
    double sum_m2 = 0;
    for (const HomeRoom& room : home.rooms) {
      if (room.storey_idx != storey_idx) continue;
      rooms.push_back(room.polygon);
      sum_m2 += Area(room.polygon);
    }
    EXPECT_NEAR(Area(Union(rooms)), sum_m2, 1e-6);
  }
  for (const HomeCamera& camera : home.cameras) {
    const Eigen::Vector2d p = camera.home_from_cam.translation.head<2>();
    const bool is_in_doorway =
        std::any_of(home.openings.begin(), home.openings.end(), [&](const HomeOpening& opening) {
          return opening.IsPassable() &&
                 DistanceToSegment(p, opening.a, opening.b) <= opening.thickness_m;
        });
    EXPECT_TRUE(Contains(home.RoomById(camera.room_id).polygon, p) || is_in_doorway);
  }
}

std::set<int> ReachableRooms(const Home& home, int from_room_id = 0) {
  std::set<int> reached = {from_room_id};
  for (size_t pass = 0; pass < home.rooms.size(); ++pass) {
    for (const HomeOpening& opening : home.openings) {
      if (!opening.IsPassable()) continue;
      if (reached.count(opening.room_id) + reached.count(*opening.other_room_id) == 0) continue;
      reached.insert({opening.room_id, *opening.other_room_id});
    }
  }
  return reached;
}

void ExpectPromisedOpenings(const Home& home) {
  int num_leafless = 0, num_open = 0, num_closed = 0, num_windows = 0;
  for (const HomeOpening& opening : home.openings) {
    const double width_m = (opening.b - opening.a).norm();
    if (opening.kind == OpeningKind::kWindow) {
      ++num_windows;
      continue;
    }
    EXPECT_GE(width_m, 0.8 - 1e-9);
    EXPECT_LE(width_m, 0.9 + 1e-9);
    EXPECT_NEAR(opening.head_z - opening.sill_z, 2.0, 1e-9);
    num_leafless += opening.leaf == DoorLeaf::kNone;
    num_open += opening.leaf == DoorLeaf::kOpen;
    num_closed += opening.leaf == DoorLeaf::kClosed;
  }
  EXPECT_GE(num_leafless, 1);
  EXPECT_GE(num_open, 1);
  EXPECT_GE(num_closed, 1);
  EXPECT_GE(num_windows, 1);
}

void ExpectPromisedCameras(const Home& home) {
  std::vector<int> num_cameras(home.rooms.size(), 0);
  for (const HomeCamera& camera : home.cameras) {
    ++num_cameras[static_cast<size_t>(camera.room_id)];
    const double height_m =
        camera.home_from_cam.translation.z() - home.RoomById(camera.room_id).floor_z;
    EXPECT_GE(height_m, 1.29);
    EXPECT_LE(height_m, 1.61);
  }
  for (const int n : num_cameras) {
    EXPECT_GE(n, 1);
    EXPECT_LE(n, 2);
  }
}

TEST(MakeHome, FlatsHoldWhatThePresetPromisesOver1000Seeds) {
  int num_l_shapes = 0, num_two_cameras = 0, num_boxes = 0;
  std::set<size_t> room_counts;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kFlat);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    room_counts.insert(home.rooms.size());
    EXPECT_EQ(ReachableRooms(home).size(), home.rooms.size());
    ExpectPromisedOpenings(home);
    ExpectPromisedCameras(home);
    num_two_cameras += home.cameras.size() > home.rooms.size();
    for (const HomeRoom& room : home.rooms) num_l_shapes += room.polygon.outer.size() == 6;
    num_boxes += static_cast<int>(home.boxes.size());
    const Eigen::Matrix3d& r = home.home_from_world.rotation;
    EXPECT_GE(std::abs(WrapQuarter(std::atan2(r(1, 0), r(0, 0)))), DegToRad(2.9));
  }
  EXPECT_THAT(room_counts, ElementsAre(3, 4, 5));
  EXPECT_GE(num_l_shapes, kSeeds / 5);
  EXPECT_GE(num_two_cameras, kSeeds / 2);
  EXPECT_GE(num_boxes, kSeeds * 10);
}

TEST(MakeHome, SingleRoomsAreValidOver1000Seeds) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kRoom);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    EXPECT_EQ(home.rooms.size(), 1u);
    ExpectPromisedCameras(home);
  }
}

// Walls that run along neither axis of the home.
int NumFreeRooms(const Home& home) {
  std::set<int> rooms;
  for (const HomeWall& wall : HomeWalls(home)) {
    const Eigen::Vector2d along = wall.Along().cwiseAbs();
    if (along.minCoeff() > 0.01) rooms.insert(wall.room_id);
  }
  return static_cast<int>(rooms.size());
}

struct DoorCounts {
  int open = 0, ajar = 0, closed = 0, low_windows = 0;
};

DoorCounts CountDoors(const Home& home) {
  DoorCounts counts;
  for (const HomeOpening& opening : home.openings) {
    const bool is_open = opening.leaf == DoorLeaf::kOpen;
    counts.open += is_open && opening.leaf_angle_rad > 1.2;
    counts.ajar += is_open && opening.leaf_angle_rad < 1;
    counts.closed += opening.leaf == DoorLeaf::kClosed;
    counts.low_windows += opening.kind == OpeningKind::kWindow &&
                          opening.sill_z - home.RoomById(opening.room_id).floor_z < 0.36;
  }
  return counts;
}

int NumFurnishedRooms(const Home& home) {
  std::set<int> rooms;
  for (const HomeBox& box : home.boxes) {
    if (box.finish != Finish::kMirror && !box.is_built_in) rooms.insert(box.room_id);
  }
  return static_cast<int>(rooms.size());
}

int NumRoomsOf(const Home& home, RoomUse use) {
  return static_cast<int>(std::count_if(home.rooms.begin(), home.rooms.end(),
                                        [&](const HomeRoom& room) { return room.use == use; }));
}

bool IsWideOpening(const HomeOpening& opening) {
  return opening.kind == OpeningKind::kOpening && (opening.b - opening.a).norm() > 1.5;
}

void ExpectPromisedTour(const Home& home) {
  const int num_rooms = static_cast<int>(home.rooms.size());
  EXPECT_GE(num_rooms, 5);
  EXPECT_LE(num_rooms, 8);
  EXPECT_EQ(ReachableRooms(home).size(), home.rooms.size());
  EXPECT_EQ(NumRoomsOf(home, RoomUse::kHall), 1);
  EXPECT_TRUE(num_rooms == 5 || NumRoomsOf(home, RoomUse::kCloset) >= 1);
  const int num_free = NumFreeRooms(home);
  EXPECT_GE(num_free, 1);
  EXPECT_LE(num_free, 2);
  const DoorCounts doors = CountDoors(home);
  EXPECT_GE(doors.open, 1);
  EXPECT_GE(doors.ajar, 1);
  EXPECT_GE(doors.closed, 1);
  const bool has_mirror = std::any_of(home.boxes.begin(), home.boxes.end(), [](const HomeBox& box) {
    return box.finish == Finish::kMirror;
  });
  EXPECT_TRUE(has_mirror || doors.low_windows > 0);
  EXPECT_TRUE(std::any_of(home.openings.begin(), home.openings.end(), IsWideOpening));
  EXPECT_LE(2 * NumFurnishedRooms(home), num_rooms + 1);
}

void ExpectTourCameras(const Home& home) {
  EXPECT_GE(home.cameras.size(), 8u);
  EXPECT_LE(home.cameras.size(), 12u);
  std::set<int> seen;
  for (const HomeCamera& camera : home.cameras) seen.insert(camera.room_id);
  EXPECT_EQ(static_cast<int>(seen.size()) + NumRoomsOf(home, RoomUse::kCloset),
            static_cast<int>(home.rooms.size()));
}

// What is fixed to the walls, told by its measures (fitting_pieces.cc); plates are sockets and
// switches.
struct FittingCounts {
  int radiators = 0, curtains = 0, wardrobes = 0, bulkheads = 0, plates = 0;

  void Add(const Home& home, const HomeBox& box) {
    const HomeRoom& room = home.RoomById(box.room_id);
    const double low_m = box.z0 - room.floor_z, high_m = box.z1 - room.floor_z;
    const bool is_tall = low_m < 0.02 && high_m > 1.9;
    radiators += std::abs(low_m - 0.12) < 1e-9 && std::abs(box.size.y() - 0.053) < 1e-9;
    curtains += is_tall && box.finish == Finish::kFabric;
    wardrobes += is_tall && room.use == RoomUse::kBedroom && box.size.y() > 0.5;
    bulkheads += low_m > 2.11 && box.z1 == room.ceiling_z && box.finish == Finish::kPaint;
    const bool is_rocker = std::abs(box.size.x() - 0.034) < 1e-9 && box.size.y() > 0.015;
    plates += std::abs(box.size.x() - 0.075) < 1e-9 || is_rocker;
  }
};

FittingCounts CountFittings(const Home& home) {
  FittingCounts counts;
  for (const HomeBox& box : home.boxes) {
    if (box.is_built_in) counts.Add(home, box);
  }
  return counts;
}

// How many of the homes and rooms have what tours promise of fittings.
struct FittingShares {
  int homes = 0, rooms = 0, bedrooms = 0;
  int with_radiators = 0, with_curtains = 0;
  FittingCounts total;

  void Add(const Home& home) {
    const FittingCounts counts = CountFittings(home);
    ++homes;
    rooms += static_cast<int>(home.rooms.size()) - NumRoomsOf(home, RoomUse::kCloset);
    bedrooms += NumRoomsOf(home, RoomUse::kBedroom);
    with_radiators += counts.radiators > 0;
    with_curtains += counts.curtains > 0;
    total.wardrobes += counts.wardrobes;
    total.bulkheads += counts.bulkheads;
    total.plates += counts.plates;
  }

  void ExpectPromised() const {
    EXPECT_GE(with_radiators, homes * 0.35);
    EXPECT_LE(with_radiators, homes * 0.55);
    EXPECT_GE(with_curtains, homes * 0.5);
    EXPECT_GE(total.wardrobes, bedrooms * 0.6);
    EXPECT_GE(total.bulkheads, rooms * 0.15);
    EXPECT_GE(total.plates, rooms * 5);
  }
};

// Passages between rooms with cameras, and how many of them have one that stands there.
struct PassageCounts {
  int all = 0, with_camera = 0;

  void Add(const Home& home) {
    const auto is_closet = [&](int room_id) {
      return home.RoomById(room_id).use == RoomUse::kCloset;
    };
    for (const HomeOpening& opening : home.openings) {
      if (!opening.IsPassable() || is_closet(opening.room_id) || is_closet(*opening.other_room_id))
        continue;
      const Eigen::Vector2d middle =
          0.5 * (opening.a + opening.b) + 0.5 * opening.thickness_m * opening.IntoWall();
      ++all;
      with_camera +=
          std::any_of(home.cameras.begin(), home.cameras.end(), [&](const HomeCamera& camera) {
            return (camera.home_from_cam.translation.head<2>() - middle).norm() < 0.85;
          });
    }
  }
};

TEST(MakeHome, ToursHoldWhatThePresetPromisesOver1000Seeds) {
  PassageCounts passages;
  int num_l_or_u = 0, num_furnished = 0, num_rooms = 0, num_free = 0, num_crowns = 0;
  size_t num_cameras = 0;
  FittingShares fittings;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kTour);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    ExpectPromisedTour(home);
    ExpectTourCameras(home);
    passages.Add(home);
    fittings.Add(home);
    num_cameras += home.cameras.size();
    num_rooms += static_cast<int>(home.rooms.size());
    num_furnished += NumFurnishedRooms(home);
    num_free += NumFreeRooms(home);
    for (const HomeRoom& room : home.rooms) {
      num_l_or_u += room.polygon.outer.size() >= 6;
      num_crowns += room.crown_m > 0;
    }
  }
  EXPECT_GE(num_crowns, num_rooms * 0.4);
  EXPECT_GE(num_l_or_u, kSeeds);
  EXPECT_GE(num_free, num_rooms * 0.15);
  EXPECT_GE(num_furnished, num_rooms * 0.3);
  const double cameras_a_room = static_cast<double>(num_cameras) / fittings.rooms;
  EXPECT_GE(cameras_a_room, 1.85);
  EXPECT_LE(cameras_a_room, 2.1);
  EXPECT_GE(passages.with_camera, 0.99 * passages.all);
  fittings.ExpectPromised();
}

bool HasBuiltIns(const Home& home, RoomUse use) {
  return std::any_of(home.boxes.begin(), home.boxes.end(), [&](const HomeBox& box) {
    return box.is_built_in && home.RoomById(box.room_id).use == use;
  });
}

TEST(MakeHome, FurnitureHidesTheFloorLineOver1000Seeds) {
  int num_baths = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kFurnished);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    EXPECT_GE(HiddenFloorLineShare(home), 0.4);
    EXPECT_GE(home.rooms.size(), 3u);
    EXPECT_LE(home.rooms.size(), 5u);
    num_baths += HasBuiltIns(home, RoomUse::kBath);
  }
  EXPECT_GE(num_baths, 3 * kSeeds / 4);
}

TEST(MakeHome, WalksAreDenseAndPassEveryRoomOver100Seeds) {
  for (int seed = 0; seed < kSeeds / 10; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kWalk);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    std::set<int> seen;
    for (size_t i = 0; i < home.cameras.size(); ++i) {
      seen.insert(home.cameras[i].room_id);
      if (i == 0) continue;
      const Eigen::Vector3d step =
          home.cameras[i].home_from_cam.translation - home.cameras[i - 1].home_from_cam.translation;
      EXPECT_LE(step.norm(), 0.7);
    }
    EXPECT_EQ(seen.size(), home.rooms.size());
    EXPECT_GE(home.cameras.size(), 6 * home.rooms.size());
  }
}

struct HardParts {
  int wide_openings = 0, glass_walls = 0, glass_doors = 0, mirrors = 0, pillars = 0, to_ceiling = 0;
};

HardParts CountHardParts(const Home& home) {
  HardParts parts;
  for (const HomeOpening& opening : home.openings) {
    const bool is_window = opening.kind == OpeningKind::kWindow;
    const double sill_m = opening.sill_z - home.RoomById(opening.room_id).floor_z;
    parts.wide_openings += IsWideOpening(opening);
    parts.glass_walls += is_window && opening.other_room_id && sill_m < 0.05;
    parts.glass_doors += is_window && !opening.other_room_id && sill_m < 0.05;
  }
  for (const HomeBox& box : home.boxes) {
    parts.mirrors += box.finish == Finish::kMirror;
    parts.to_ceiling += box.z1 > home.RoomById(box.room_id).ceiling_z - 1e-9;
  }
  for (const HomeRoom& room : home.rooms)
    parts.pillars += static_cast<int>(room.polygon.holes.size());
  return parts;
}

double TiltOf(const HomeCamera& camera) {
  return std::acos(std::min(1.0, -camera.home_from_cam.rotation(2, 1)));
}

TEST(MakeHome, HardHomesHoldWhatThePresetPromisesOver1000Seeds) {
  int num_sloped = 0, num_loops = 0, num_fitted = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kHard);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    const HardParts parts = CountHardParts(home);
    EXPECT_GE(parts.wide_openings, 1);
    EXPECT_GE(parts.glass_walls, 1);
    EXPECT_GE(parts.glass_doors, 1);
    EXPECT_GE(parts.mirrors, 2);
    EXPECT_GE(parts.pillars, 1);
    EXPECT_GE(parts.to_ceiling, 1);
    EXPECT_GE(NumRoomsOf(home, RoomUse::kCloset), 1);
    ExpectTourCameras(home);
    num_fitted += CountFittings(home).plates > 0;
    size_t num_passable = 0;
    for (const HomeOpening& opening : home.openings) num_passable += opening.IsPassable();
    num_loops += num_passable >= home.rooms.size();
    double most_tilt = 0, least_exposure = 9, most_exposure = 0;
    for (const HomeCamera& camera : home.cameras) {
      most_tilt = std::max(most_tilt, TiltOf(camera));
      least_exposure = std::min(least_exposure, camera.exposure);
      most_exposure = std::max(most_exposure, camera.exposure);
      EXPECT_TRUE(camera.claimed_home_from_cam.has_value());
    }
    EXPECT_GT(most_tilt, DegToRad(0.8));
    EXPECT_LT(most_tilt, DegToRad(3.5));
    EXPECT_GT(most_exposure / least_exposure, 1.25);
    for (const HomeRoom& room : home.rooms) num_sloped += !room.HasLevelCeiling();
  }
  EXPECT_GE(num_sloped, kSeeds / 5);
  EXPECT_GE(num_loops, 3 * kSeeds / 10);
  EXPECT_EQ(num_fitted, kSeeds);
}

// Ids are dense and name each room, opening and picture once; what stands in a room lies between
// its floor and its ceiling.
void ExpectSoundStoreys(const Home& home) {
  double ceiling_z = -1e9;
  for (int storey_idx = 0; storey_idx < home.NumStoreys(); ++storey_idx) {
    double lowest_z = 1e9, highest_z = -1e9;
    size_t num_rooms = 0;
    int first_id = -1;
    for (const HomeRoom& room : home.rooms) {
      if (room.storey_idx != storey_idx) continue;
      if (num_rooms++ == 0) first_id = room.id;
      lowest_z = std::min(lowest_z, room.floor_z);
      highest_z = std::max(highest_z, room.ceiling_z);
      EXPECT_TRUE(room.HasLevelCeiling());
    }
    EXPECT_GE(lowest_z, ceiling_z + 0.299);
    ceiling_z = highest_z;
    EXPECT_EQ(ReachableRooms(home, first_id).size(), num_rooms);
  }
  for (size_t i = 0; i < home.rooms.size(); ++i) EXPECT_EQ(home.rooms[i].id, static_cast<int>(i));
  for (size_t i = 0; i < home.openings.size(); ++i)
    EXPECT_EQ(home.openings[i].id, static_cast<int>(i));
  std::set<std::string> pictures;
  for (const HomeCamera& camera : home.cameras) {
    pictures.insert(camera.picture);
    const double height_m =
        camera.home_from_cam.translation.z() - home.RoomById(camera.room_id).floor_z;
    EXPECT_GT(height_m, 1.25);
    EXPECT_LT(height_m, 1.7);
  }
  EXPECT_EQ(pictures.size(), home.cameras.size());
  for (const HomeLamp& lamp : home.lamps)
    EXPECT_GT(home.RoomById(lamp.room_id).CeilingAt(lamp.center.head<2>()), lamp.center.z());
}

TEST(MakeHome, StoreysLieOnEachOtherOver300Seeds) {
  for (int seed = 0; seed < 3 * kSeeds / 10; ++seed) {
    SCOPED_TRACE(seed);
    const HomePreset preset = seed % 2 == 0 ? HomePreset::kFlat : HomePreset::kTour;
    const int storeys = 2 + seed / 2 % 2;
    const Home home = Make(seed, preset, storeys);
    EXPECT_EQ(home.NumStoreys(), storeys);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    ExpectSoundStoreys(home);
    if (preset == HomePreset::kFlat) ExpectPromisedCameras(home);
  }
}

// The lowest storey of a flat or the one above it is the flat that the seed gives alone.
TEST(MakeHome, StoreysDoNotChangeTheHomeOfTheSeed) {
  const Home one = Make(4, HomePreset::kFlat), two = Make(4, HomePreset::kFlat, 2);
  std::vector<double> areas;
  for (const HomeRoom& room : two.rooms) areas.push_back(Area(room.polygon));
  for (const HomeRoom& room : one.rooms)
    EXPECT_THAT(areas, ::testing::Contains(::testing::DoubleNear(Area(room.polygon), 1e-9)));
  EXPECT_EQ(two.seed, 4u);
}

TEST(MakeHome, OnlyFlatsAndToursHaveStoreys) {
  for (const HomePreset preset : {HomePreset::kRoom, HomePreset::kFurnished, HomePreset::kWalk,
                                  HomePreset::kHard, HomePreset::kBuilding}) {
    EXPECT_THROW((void)Make(1, preset, 2), InvalidInputError);
  }
  EXPECT_THROW((void)Make(1, HomePreset::kFlat, 0), InvalidInputError);
  EXPECT_THROW((void)Make(1, HomePreset::kFlat, 4), InvalidInputError);
}

void ExpectPromisedBuilding(const Home& home) {
  EXPECT_EQ(ReachableRooms(home).size(), home.rooms.size());
  std::map<int, int> num_doors, num_cameras;
  for (const HomeOpening& opening : home.openings) {
    if (!opening.IsPassable()) continue;
    ++num_doors[opening.room_id];
    EXPECT_EQ(home.RoomById(*opening.other_room_id).use, RoomUse::kHall);
  }
  for (const HomeCamera& camera : home.cameras) ++num_cameras[camera.room_id];
  for (const HomeRoom& room : home.rooms) {
    if (room.use == RoomUse::kHall) {
      EXPECT_GE(num_cameras[room.id] * 4, std::sqrt(Area(room.polygon)));
    } else {
      EXPECT_EQ(num_doors[room.id], 1);
      EXPECT_EQ(num_cameras[room.id], 1);
    }
  }
}

TEST(MakeHome, BuildingsHoldWhatThePresetPromisesOver50Seeds) {
  for (int seed = 0; seed < kSeeds / 20; ++seed) {
    SCOPED_TRACE(seed);
    const Home home = Make(seed, HomePreset::kBuilding);
    EXPECT_GE(home.rooms.size(), 20u);
    EXPECT_LE(home.rooms.size(), 40u);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    ExpectPromisedBuilding(home);
  }
}

TEST(MakeHome, BuildingsHaveUpTo200Rooms) {
  HomeOptions options;
  options.preset = HomePreset::kBuilding;
  for (const int rooms : {20, 25, 26, 51, 200}) {
    SCOPED_TRACE(rooms);
    options.rooms = rooms;
    const Home home = MakeHome(options);
    EXPECT_EQ(static_cast<int>(home.rooms.size()), rooms);
    ASSERT_NO_FATAL_FAILURE(ExpectSoundPlan(home));
    ExpectPromisedBuilding(home);
  }
  options.rooms = 201;
  EXPECT_THROW((void)MakeHome(options), InvalidInputError);
}

TEST(MakeHome, SameSeedSameHomeOtherSeedOtherHome) {
  const Home a = Make(5, HomePreset::kFlat), b = Make(5, HomePreset::kFlat);
  const Home c = Make(6, HomePreset::kFlat);
  EXPECT_EQ(a.rooms[0].polygon.outer, b.rooms[0].polygon.outer);
  EXPECT_EQ(a.cameras[0].home_from_cam.translation, b.cameras[0].home_from_cam.translation);
  EXPECT_NE(a.rooms[0].polygon.outer, c.rooms[0].polygon.outer);
}

TEST(MakeHome, FurnitureShareZeroLeavesRoomsEmpty) {
  HomeOptions options;
  options.furniture = 0;
  EXPECT_THAT(MakeHome(options).boxes, IsEmpty());
}

TEST(MakeHome, HasTheRoomsThatAreAskedFor) {
  HomeOptions options;
  for (options.rooms = 3; options.rooms <= 5; ++options.rooms)
    EXPECT_EQ(static_cast<int>(MakeHome(options).rooms.size()), options.rooms);
  EXPECT_THROW((void)MakeHome(options), InvalidInputError);  // a flat of six
  options.preset = HomePreset::kTour;
  EXPECT_EQ(MakeHome(options).rooms.size(), 6u);
}

TEST(MakeHome, RefusesOptionsOutOfRange) {
  HomeOptions options;
  options.furniture = 1.5;
  EXPECT_THROW((void)MakeHome(options), InvalidInputError);
  options.furniture = 0.5;
  options.seed = -1;
  EXPECT_THROW((void)MakeHome(options), InvalidInputError);
}

TEST(HomeWalls, RoomLiesOnTheLeftAndOpeningsBreakBothFaces) {
  const Home home = Make(3, HomePreset::kFlat);
  const std::vector<HomeWall> walls = HomeWalls(home);
  for (const HomeWall& wall : walls) {
    const Eigen::Vector2d beside = 0.5 * (wall.a + wall.b) + 0.01 * wall.Inward();
    EXPECT_TRUE(Contains(home.RoomById(wall.room_id).polygon, beside));
  }
  for (const HomeOpening& opening : home.openings) {
    int num_faces = 0;
    for (const HomeWall& wall : walls) {
      const auto on = OpeningOnWall(opening, wall);
      if (!on) continue;
      ++num_faces;
      EXPECT_NEAR(on->second - on->first, (opening.b - opening.a).norm(), 1e-9);
    }
    EXPECT_EQ(num_faces, opening.other_room_id ? 2 : 1);
  }
}

}  // namespace
}  // namespace enfilade
