// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/cameras.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "enfilade/geometry/angles.h"
#include "src/synthetic/outline.h"
#include "src/synthetic/placement.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kCameraClearance_m = 0.65;
constexpr double kHallClearance_m = 0.42;
constexpr double kCameraSpacing_m = 1.6;
// Where a small room has no place so far from the first, tours take one at this distance.
constexpr double kNearSpacing_m = 1.0;
// Agents take a panorama at every passage between rooms that they photograph: in the ZInD sample
// tour one stands 0.1-0.6 m from the middle of each inner door (0.97 m from the garage's), 0.2-0.8
// m from that of each wide opening.
constexpr double kDoorstep_m = 0.8;
// A place from which a whole room comes into view is worth this much clearance.
constexpr double kViewWeight_m = 2.0;
constexpr double kTwoCamerasArea_m2 = 13;
constexpr int kMinTourCameras = 8, kMaxTourCameras = 12;

// True when no wall of the room stands between two places in it.
bool Sees(const HomeRoom& room, const Vector2d& from, const Vector2d& to) {
  const double distance_m = (to - from).norm();
  if (distance_m == 0) return true;
  return RayDistance(room.polygon.outer, from, (to - from) / distance_m) >= distance_m;
}

// Points of a room on a coarse grid that none of `taken` sees past the room's own corners.
std::vector<Vector2d> UnseenPoints(const HomeRoom& room, const Rectangle& bounds,
                                   const std::vector<Vector2d>& taken) {
  constexpr double kStep_m = 0.3;
  std::vector<Vector2d> points;
  for (double y = bounds.min.y() + kStep_m / 2; y < bounds.max.y(); y += kStep_m) {
    for (double x = bounds.min.x() + kStep_m / 2; x < bounds.max.x(); x += kStep_m) {
      const Vector2d p(x, y);
      const bool is_seen = std::any_of(taken.begin(), taken.end(),
                                       [&](const Vector2d& q) { return Sees(room, q, p); });
      if (Contains(room.polygon, p) && !is_seen) points.push_back(p);
    }
  }
  return points;
}

// The best of many random places, none when all are too narrow or within `spacing_m` of `taken`:
// clear of walls and furniture, and with much of the room in view that was not seen yet.
std::optional<Vector2d> ClearestPlace(const Home& home, const HomeRoom& room,
                                      const std::vector<Vector2d>& taken, double spacing_m,
                                      Random& random) {
  constexpr int kTries = 150;
  const Rectangle bounds = BoundsOf(room.polygon.outer);
  const std::vector<Vector2d> unseen = UnseenPoints(room, bounds, taken);
  const double min_clear_m = room.use == RoomUse::kHall ? kHallClearance_m : kCameraClearance_m;
  double best_value = 0;
  std::optional<Vector2d> best;
  for (int i = 0; i < kTries; ++i) {
    const Vector2d p(random.Millimetres(bounds.min.x(), bounds.max.x()),
                     random.Millimetres(bounds.min.y(), bounds.max.y()));
    // Beyond 1.2 m one place is as good as another: cameras need not stand in the middle.
    const double clear_m = std::min(Clearance(home, room.id, p), random.Uniform(1.1, 1.2));
    const bool is_apart = std::all_of(
        taken.begin(), taken.end(), [&](const Vector2d& q) { return (p - q).norm() > spacing_m; });
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

bool AddPlace(const Home& home, RoomCameras& cameras, double spacing_m, Random& random) {
  const std::optional<Vector2d> place =
      ClearestPlace(home, *cameras.room, cameras.places, spacing_m, random);
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

// Every room gets its second camera before any gets a third; of those with equally many, the one
// with the most floor comes first.
bool IsNextBefore(const RoomCameras& a, const RoomCameras& b) {
  if (a.is_full != b.is_full) return b.is_full;
  if (a.places.size() != b.places.size()) return a.places.size() < b.places.size();
  return Area(a.room->polygon) > Area(b.room->polygon);
}

// The clearest of many random places in front of a door or opening, on the side of one room.
std::optional<Vector2d> PlaceAtDoor(const Home& home, const HomeOpening& door, int room_id,
                                    Random& random) {
  constexpr int kTries = 40;
  const Vector2d out = room_id == door.room_id ? Vector2d(-door.IntoWall()) : door.IntoWall();
  const double depth_m = room_id == door.room_id ? 0 : door.thickness_m;
  const Vector2d along = (door.b - door.a).normalized();
  double best_m = kHallClearance_m;
  std::optional<Vector2d> best;
  for (int i = 0; i < kTries; ++i) {
    const Vector2d p = 0.5 * (door.a + door.b) +
                       (depth_m + random.Millimetres(kHallClearance_m, 0.7)) * out +
                       random.Millimetres(-0.25, 0.25) * along;
    const double clear_m = Clearance(home, room_id, p);
    if (clear_m <= best_m) continue;
    best_m = clear_m;
    best = p;
  }
  return best;
}

// Whether one of a room's cameras stands at the door.
bool IsAtDoor(const HomeOpening& door, const RoomCameras& cameras) {
  const Vector2d middle = 0.5 * (door.a + door.b) + 0.5 * door.thickness_m * door.IntoWall();
  return std::any_of(cameras.places.begin(), cameras.places.end(),
                     [&](const Vector2d& p) { return (p - middle).norm() < kDoorstep_m; });
}

// Puts a camera at each door or opening between two of the rooms, into the one with fewer cameras
// where there is a place, the larger of two with equally many. Returns how many.
int AddDoorPlaces(const Home& home, std::vector<RoomCameras>& rooms, Random& random) {
  int added = 0;
  for (const HomeOpening& door : home.openings) {
    if (!door.IsPassable()) continue;
    std::vector<RoomCameras*> sides;
    for (RoomCameras& room : rooms) {
      if (room.room->id == door.room_id || room.room->id == *door.other_room_id)
        sides.push_back(&room);
    }
    if (sides.size() < 2 || IsAtDoor(door, *sides[0]) || IsAtDoor(door, *sides[1])) continue;
    if (IsNextBefore(*sides[1], *sides[0])) std::swap(sides[0], sides[1]);
    for (RoomCameras* side : sides) {
      const std::optional<Vector2d> place = PlaceAtDoor(home, door, side->room->id, random);
      if (!place) continue;
      side->places.push_back(*place);
      ++added;
      break;
    }
  }
  return added;
}

// A turn about a random level axis.
Eigen::Matrix3d Leaning(double by_rad, Random& random) {
  const double azimuth = random.Uniform(-kPi, kPi);
  const Eigen::Vector3d axis(std::cos(azimuth), std::sin(azimuth), 0);
  return Eigen::AngleAxisd(by_rad, axis).toRotationMatrix();
}

// Of the most by which a picture may be too bright, or dark if negative. The first two lie apart.
double ExposureShare(size_t camera_idx, Random& random) {
  if (camera_idx == 0) return random.Uniform(0.5, 1.0);
  if (camera_idx == 1) return random.Uniform(-1.0, -0.5);
  return random.Uniform(-1.0, 1.0);
}

}  // namespace

double Clearance(const Home& home, int room_id, const Vector2d& p) {
  const HomeRoom& room = home.RoomById(room_id);
  if (!Contains(room.polygon, p)) return -1;
  double nearest = std::numeric_limits<double>::infinity();
  const auto add_box = [&](const HomeBox& box) {
    const Ring2 ring = box.Footprint();
    nearest = std::min(nearest, Contains(ring, p) ? -1 : DistanceToRing(ring, p));
  };
  for (const Ring2& ring : RingsOf(room.polygon)) {
    nearest = std::min(nearest, DistanceToRing(ring, p));
  }
  for (const HomeBox& box : home.boxes) {
    if (box.room_id == room_id) add_box(box);
  }
  for (const HomeOpening& opening : home.openings) {
    // Leaves in other rooms are farther away than a wall.
    if (opening.leaf == DoorLeaf::kOpen && opening.room_id == room_id) add_box(OpenLeaf(opening));
  }
  return nearest;
}

std::string PictureName(size_t number) {
  const std::string digits = std::to_string(number);
  return "pano_" + std::string(3 - std::min<size_t>(digits.size(), 3), '0') + digits + ".jpg";
}

void AddCamera(Home& home, int room_id, const Eigen::Vector3d& position, double azimuth_rad) {
  HomeCamera camera;
  camera.picture = PictureName(home.cameras.size());
  camera.room_id = room_id;
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  camera.home_from_cam.rotation.col(0) = Eigen::Vector3d(s, -c, 0);
  camera.home_from_cam.rotation.col(1) = Eigen::Vector3d(0, 0, -1);
  camera.home_from_cam.rotation.col(2) = Eigen::Vector3d(c, s, 0);
  camera.home_from_cam.translation = position;
  home.cameras.push_back(camera);
}

void DisturbCameras(Home& home, const HomeRecipe& recipe, Random& random) {
  const PoseErrors& errors = recipe.errors;
  for (size_t i = 0; i < home.cameras.size(); ++i) {
    HomeCamera& camera = home.cameras[i];
    if (recipe.exposure_stops > 0)
      camera.exposure = std::exp2(recipe.exposure_stops * ExposureShare(i, random));
    Eigen::Matrix3d& rotation = camera.home_from_cam.rotation;
    if (recipe.tilt_rad > 0)
      rotation = Leaning(random.Uniform(-recipe.tilt_rad, recipe.tilt_rad), random) * rotation;
    if (errors.position_m + errors.yaw_rad + errors.tilt_rad <= 0) continue;
    Rigid3 claimed = camera.home_from_cam;
    for (int k = 0; k < 2; ++k) claimed.translation[k] += errors.position_m * random.Normal();
    claimed.rotation = RotationZ(errors.yaw_rad * random.Normal()) * claimed.rotation;
    camera.claimed_home_from_cam = claimed;
    rotation = Leaning(errors.tilt_rad * random.Normal(), random) * rotation;
  }
}

void TiltCameras(Home& home, double max_tilt_rad, Random& random) {
  for (HomeCamera& camera : home.cameras) {
    const double by_rad = random.Uniform(0, max_tilt_rad);
    const Eigen::Matrix3d leaning = Leaning(by_rad, random);
    camera.home_from_cam.rotation = leaning * camera.home_from_cam.rotation;
    if (!camera.claimed_home_from_cam) continue;
    camera.claimed_home_from_cam->rotation = leaning * camera.claimed_home_from_cam->rotation;
  }
}

bool PlaceTourCameras(Home& home, Random& random) {
  const double height_m = random.Millimetres(1.3, 1.65);
  const int more = random.Index(3);
  std::vector<RoomCameras> rooms;
  for (const HomeRoom& room : home.rooms) {
    if (room.use == RoomUse::kCloset) continue;
    rooms.push_back({&room, {}, false});
  }
  const int wanted =
      std::clamp(2 * static_cast<int>(rooms.size()) + more, kMinTourCameras, kMaxTourCameras);
  int total = AddDoorPlaces(home, rooms, random);
  for (RoomCameras& room : rooms) {
    if (!room.places.empty()) continue;
    if (!AddPlace(home, room, kCameraSpacing_m, random)) return false;
    ++total;
  }
  while (total < wanted) {
    const auto next = std::min_element(rooms.begin(), rooms.end(), IsNextBefore);
    if (next->is_full) break;
    if (AddPlace(home, *next, kCameraSpacing_m, random) ||
        AddPlace(home, *next, kNearSpacing_m, random)) {
      ++total;
    }
  }
  if (total < kMinTourCameras) return false;
  for (const RoomCameras& room : rooms) AddCameras(home, room, height_m, 0.02, random);
  return true;
}

bool PlaceCameras(Home& home, Random& random) {
  const double height_m = random.Millimetres(1.3, 1.6);
  for (const HomeRoom& room : home.rooms) {
    const int wanted = home.rooms.size() == 1 || Area(room.polygon) > kTwoCamerasArea_m2 ? 2 : 1;
    RoomCameras cameras{&room, {}, false};
    while (static_cast<int>(cameras.places.size()) < wanted && !cameras.is_full) {
      (void)AddPlace(home, cameras, kCameraSpacing_m, random);
    }
    if (cameras.places.empty()) return false;
    AddCameras(home, cameras, height_m, 0.01, random);
  }
  return true;
}

bool PlaceBuildingCameras(Home& home, Random& random) {
  constexpr double kSpacing_m = 4, kAside_m = 0.15;
  const double height_m = random.Millimetres(1.3, 1.6);
  for (const HomeRoom& room : home.rooms) {
    RoomCameras cameras{&room, {}, false};
    if (room.use == RoomUse::kHall) {
      cameras.places = PlacesAlong(BoundsOf(room.polygon.outer), kSpacing_m);
      for (Vector2d& p : cameras.places) {
        for (int k = 0; k < 2; ++k) p[k] += random.Millimetres(-kAside_m, kAside_m);
      }
    } else if (!AddPlace(home, cameras, kCameraSpacing_m, random)) {
      return false;
    }
    AddCameras(home, cameras, height_m, 0.01, random);
  }
  return true;
}

}  // namespace enfilade
