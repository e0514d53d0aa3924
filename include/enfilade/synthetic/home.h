// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/polygon2.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {

/// What kind of home is made, and how it is photographed: MakeHome says what each one holds.
enum class HomePreset { kRoom, kFlat, kTour, kFurnished, kWalk, kHard, kBuilding };
[[nodiscard]] std::span<const std::string_view> EnumNames(HomePreset);

/// Width of the panoramas that are usual for the preset, pixels.
[[nodiscard]] int UsualWidth(HomePreset preset);

struct HomeOptions {
  int seed = 1;
  HomePreset preset = HomePreset::kFlat;
  int rooms = 0;
  int storeys = 1;
  double furniture = 0.5;
  double tilt_deg = 0;

  void Visit(OptionVisitor& v) {
    v("seed", seed, "Every number of the home comes from it.", {0, 2147483647});
    v("preset", preset,
      "room: one room; flat: three to five rooms joined by doors; tour: 5 to 8 rooms as an agent "
      "photographs them; furnished: a flat whose furniture hides 40 % of the floor line; walk: a "
      "flat along a dense path; hard: open plan, glass, mirrors, tilt, pillars, niches; building: "
      "20 to 200 rooms along corridors.");
    v("rooms", rooms, "Number of rooms on a storey, within what the preset allows; 0: drawn.",
      {0, 1000});
    v("storeys", storeys, "Storeys on top of each other; more than one for flat and tour only.",
      {1, 3});
    v("furniture", furniture, "Share of the furniture that a room can take, 0 for empty rooms.",
      {0.0, 1.0});
    v("tilt_deg", tilt_deg,
      "Every camera leans by up to this, and what is said of its pose as well; 0: as the preset "
      "has it.",
      {0.0, 30.0});
  }
};

/// What a surface is made of: its pattern; the colour is given apart.
enum class Finish {
  kPaint,
  kCarpet,
  kPlanks,
  kTiles,
  kWood,
  kFabric,
  kPlain,
  kMirror,
  kOrangePeel  ///< paint from a roller or a spray gun
};
enum class RoomUse { kLiving, kBedroom, kKitchen, kBath, kHall, kCloset };

/// The region inside the inner faces of a room's walls, from a level floor to a plane ceiling.
struct HomeRoom {
  int id = 0;
  int storey_idx = 0;  ///< from bottom to top
  Polygon2 polygon;
  double floor_z = 0;
  double ceiling_z = 2.5;               ///< of its lowest point
  Eigen::Vector2d ceiling_slope{0, 0};  ///< rise per metre along x and y; zero for level ones
  double crown_m = 0;                   ///< height of the moulding under the ceiling
  RoomUse use = RoomUse::kLiving;
  Finish floor_finish = Finish::kCarpet;
  Finish wall_finish = Finish::kPaint;
  Eigen::Vector3f wall_rgb{0.80f, 0.79f, 0.76f};  ///< diffuse reflectance, linear
  Eigen::Vector3f floor_rgb{0.35f, 0.30f, 0.25f};
  Eigen::Vector3f ceiling_rgb{0.82f, 0.82f, 0.80f};

  [[nodiscard]] bool HasLevelCeiling() const { return ceiling_slope.isZero(); }
  /// Height of the ceiling's plane above z = 0 at a place.
  [[nodiscard]] double CeilingAt(const Eigen::Vector2d& p) const;
};

enum class DoorLeaf { kNone, kOpen, kClosed };

/// A hole through a wall. a → b runs along the wall face of `room_id` with the room on its left;
/// the hole goes through to the parallel face `thickness_m` to its right.
struct HomeOpening {
  int id = 0;
  OpeningKind kind = OpeningKind::kDoor;
  Eigen::Vector2d a, b;
  int room_id = 0;
  std::optional<int> other_room_id;  ///< none where it leads outside
  double thickness_m = 0.12;
  double sill_z = 0;
  double head_z = 2.0;
  DoorLeaf leaf = DoorLeaf::kNone;  ///< doors only; openings have none
  double leaf_angle_rad = 0;        ///< open leaves: swung into `room_id` by this from closed
  bool is_hinge_at_a = true;

  /// True when one can look through it from one room into another.
  [[nodiscard]] bool IsPassable() const {
    return kind != OpeningKind::kWindow && leaf != DoorLeaf::kClosed && other_room_id.has_value();
  }
  /// Unit, from the face of `room_id` into the wall.
  [[nodiscard]] Eigen::Vector2d IntoWall() const {
    const Eigen::Vector2d along = (b - a).normalized();
    return {along.y(), -along.x()};
  }
};

/// A box of furniture: `size` along its own axes, turned by `yaw_rad` about its centre.
struct HomeBox {
  int item = 0;              ///< boxes of one piece of furniture share it
  bool is_built_in = false;  ///< stays when the furniture is gone
  int room_id = 0;
  Eigen::Vector2d center{0, 0};
  Eigen::Vector2d size{1, 1};
  double yaw_rad = 0;
  double z0 = 0, z1 = 1;
  Finish finish = Finish::kPlain;
  Eigen::Vector3f rgb{0.5f, 0.5f, 0.5f};  ///< diffuse reflectance, linear

  [[nodiscard]] Ring2 Footprint() const;
};

/// A lamp under the ceiling: a level rectangle that shines downwards.
struct HomeLamp {
  int room_id = 0;
  Eigen::Vector3d center{0, 0, 2.4};
  Eigen::Vector2d size{0.4, 0.4};
  Eigen::Vector3f radiance{10, 10, 10};
};

/// Parallel light from outside.
struct HomeSun {
  Eigen::Vector3d direction{0, 0, 1};      ///< unit, towards the sun, in the home frame
  Eigen::Vector3f irradiance{15, 14, 12};  ///< on a surface that faces it
};

/// Where a panorama is taken.
struct HomeCamera {
  std::string picture;  ///< file name below panos/
  int room_id = 0;
  Rigid3 home_from_cam;  ///< camera x right, y down, z forward
  /// What whoever took the picture says of its pose; none: the truth.
  std::optional<Rigid3> claimed_home_from_cam;
  double exposure = 1;  ///< factor on the light that its room asks for
};

/// A home with nothing hidden. All coordinates are in the home frame: the walls of Manhattan homes
/// run along x and y, z is up, and the world is the same frame turned about z.
struct Home {
  uint64_t seed = 0;
  Rigid3 home_from_world;     ///< rotation only, as in Structure
  double baseboard_m = 0.07;  ///< height of the baseboards, 0 for none
  std::vector<HomeRoom> rooms;
  std::vector<HomeOpening> openings;
  std::vector<HomeBox> boxes;
  std::vector<HomeLamp> lamps;
  std::optional<HomeSun> sun;  ///< none under clouds
  std::vector<HomeCamera> cameras;

  [[nodiscard]] const HomeRoom& RoomById(int id) const;
  [[nodiscard]] int NumStoreys() const;
  [[nodiscard]] bool IsOnStorey(int room_id, int storey_idx) const;
  [[nodiscard]] int StoreyOfCamera(int camera_idx) const;
  [[nodiscard]] Rigid3 WorldFromCamera(int camera_idx) const;
  /// The pose as the pose file gives it.
  [[nodiscard]] Rigid3 ClaimedWorldFromCamera(int camera_idx) const;
};

/// A home that depends on the options alone. Guarantees: HomeProblems(result) is empty; the heading
/// is at least 3° off the world's axes; all rooms are joined by passable doors or openings; every
/// room has a lamp. By preset:
///
/// Rooms are rectangles or L-shapes with one or two cameras at 1.3–1.6 m (±1 cm). Flats have three
/// to five of them, a door without leaf, one with an open leaf and a closed one.
///
/// Tours have 5–8 rooms, a hall and, from six rooms on, one or two closets among them (rectangles,
/// L, T and U shapes), walls of different thickness, one or two rooms with a bay or an outer wall
/// off the axes, two with a niche or chimney breast, doors that are open, ajar and closed, a mirror
/// or a window down to 0.35 m above the floor, a fitted kitchen and bath, loose furniture in half
/// of the rooms, what empty rooms have too (wardrobes, shelves, curtains, radiators in some homes,
/// bulkheads, sockets, switches, pictures), a sloped ceiling in some homes, and 8–12 cameras: one
/// or more in every room that is no closet, about two on average. Claimed poses are a little off,
/// and nobody has measured the cameras' tilt.
///
/// Furnished homes are flats in which furniture hides 40 % or more of the floor line
/// (HiddenFloorLineShare). Walks are flats with a camera at every 0.4–0.5 m of a path through all
/// rooms. Hard homes are tours of six rooms or more with open plan, a glass wall and a glazed door,
/// two mirrors, a pillar, a curved wall, cabinets up to the ceiling, loops of rooms, furniture in
/// all rooms, cameras that lean by up to 2° and exposures that differ by up to 1.4 stops.
///
/// Buildings have 20–40 rooms, or up to 200 where so many are asked for: wings of two rows along a
/// corridor, joined by another corridor, every room with one door to a corridor, a quarter of them
/// furnished; one camera a room and one every 4 m of the corridors.
///
/// Flats and tours may have several storeys: each is such a home of its own, entered by a closed
/// door as from a stairwell, with level ceilings; those with less ground lie higher, centred over
/// the lowest, with 0.3 m between the highest ceiling and the floor above. Room ids, pictures and
/// furniture are numbered from bottom to top. A home of one storey is the same as ever.
///
/// With a tilt, the home is the one without it but for the cameras' rotations: each camera, true
/// and claimed, is turned about its centre and a random level axis by an angle uniform in [0,
/// tilt_deg], on top of what the preset does.
///
/// Throws InvalidInputError for options out of range.
[[nodiscard]] Home MakeHome(const HomeOptions& options);

/// What is wrong with a home, one line a fault; empty for a valid one. Rooms of a storey must be
/// simple, disjoint and apart by their walls, storeys apart by a floor; openings lie within a wall
/// face (and within the face opposite), apart from each other; furniture stands inside its room,
/// free of doors and other furniture; cameras stand in free space.
[[nodiscard]] std::vector<std::string> HomeProblems(const Home& home);

/// One face of a wall, from a to b with the room on its left.
struct HomeWall {
  int id = 0;
  int room_id = 0;
  Eigen::Vector2d a, b;

  [[nodiscard]] Eigen::Vector2d Along() const { return (b - a).normalized(); }
  [[nodiscard]] Eigen::Vector2d Inward() const { return {-Along().y(), Along().x()}; }
};

/// All wall faces, room by room, outer ring before holes; ids are the positions in the result.
[[nodiscard]] std::vector<HomeWall> HomeWalls(const Home& home);

/// Where an opening breaks a wall face: the interval of distances from wall.a, none when it does
/// not. An opening between two rooms breaks one face of each.
[[nodiscard]] std::optional<std::pair<double, double>> OpeningOnWall(const HomeOpening& opening,
                                                                     const HomeWall& wall);

}  // namespace enfilade
