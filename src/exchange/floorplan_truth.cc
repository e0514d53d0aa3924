// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <system_error>

#include "enfilade/base/hash.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/floorplan/joined_rooms.h"
#include "src/exchange/picture_files.h"
#include "src/exchange/truth_sources.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// An opening stands on its wall's face up to the rounding of the file; the other face of the wall
// is cut by the same opening moved through the wall.
constexpr double kOpeningToWall_m = 0.05;

// An opening with its wall: where it cuts the two faces.
struct Cut {
  OpeningKind kind;
  int room_id;
  std::optional<int> other_room_id;
  TruthSegment near, far;
};

TruthSegment Moved(const TruthSegment& segment, const Vector2d& by) {
  return {segment[0] + by, segment[1] + by};
}

std::vector<Cut> CutsOf(const Storey& storey) {
  std::vector<Cut> cuts;
  for (const Opening& opening : storey.openings) {
    const TruthSegment near{opening.a, opening.b};
    cuts.push_back({opening.kind, opening.room_id, opening.other_room_id, near,
                    Moved(near, ThroughWall(storey, opening))});
  }
  return cuts;
}

// Takes the plan's frame to the truth's world, in plan and height.
class HomeToWorld {
 public:
  explicit HomeToWorld(const Rigid3& home_from_world)
      : world_from_home_(home_from_world.Inverse()) {}

  [[nodiscard]] Vector2d operator()(const Vector2d& p) const {
    return (world_from_home_ * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
  }
  [[nodiscard]] TruthSegment operator()(const TruthSegment& s) const {
    return {(*this)(s[0]), (*this)(s[1])};
  }
  [[nodiscard]] Ring2 operator()(const Ring2& ring) const {
    Ring2 moved;
    for (const Vector2d& p : ring) moved.push_back((*this)(p));
    return moved;
  }
  [[nodiscard]] double Height(double z) const { return z + world_from_home_.translation.z(); }

 private:
  Rigid3 world_from_home_;
};

void AppendRoom(const Room& room, int storey_idx, const std::vector<Cut>& cuts,
                const HomeToWorld& to_world, GroundTruth& truth) {
  std::vector<TruthSegment> gaps;
  for (const Cut& cut : cuts) {
    if (cut.kind == OpeningKind::kWindow) continue;
    gaps.push_back(cut.near);
    gaps.push_back(cut.far);
  }
  for (const TruthSegment& wall : CutGaps({room.polygon}, gaps, kOpeningToWall_m)) {
    truth.walls.push_back(to_world(wall));
  }
  TruthRoom made;
  made.storey_idx = storey_idx;
  made.region.push_back({to_world(room.polygon.outer), {}});
  for (const Ring2& hole : room.polygon.holes) made.region[0].holes.push_back(to_world(hole));
  made.floor_z = to_world.Height(room.floor_z);
  if (room.has_level_ceiling) made.ceiling_z = to_world.Height(room.ceiling_z);
  truth.rooms.push_back(std::move(made));
}

TruthView MakeView(const PlanCamera& camera, const std::string& sha256, const Storey& storey,
                   const std::vector<Cut>& cuts, const Rigid3& home_from_world,
                   const HomeToWorld& to_world) {
  TruthView view;
  view.picture = camera.picture;
  view.sha256 = sha256;
  view.storey_idx = camera.storey_idx;
  view.world_from_cam = camera.world_from_cam;
  const Eigen::Vector3d in_home = home_from_world * camera.world_from_cam.translation;
  const auto room = std::find_if(storey.rooms.begin(), storey.rooms.end(), [&](const Room& r) {
    return Contains(r.polygon, in_home.head<2>());
  });
  view.is_inside = room != storey.rooms.end();
  view.camera_height_m = in_home.z() - (view.is_inside ? room->floor_z : storey.floor_z);
  if (!view.is_inside) return view;
  view.visible_layout = to_world(room->polygon.outer);
  for (const Cut& cut : cuts) {
    if (cut.kind == OpeningKind::kWindow) continue;
    const bool is_near = cut.room_id == room->id;
    if (!is_near && cut.other_room_id != room->id) continue;
    auto& list = cut.kind == OpeningKind::kDoor ? view.doors : view.openings;
    list.push_back(to_world(is_near ? cut.near : cut.far));
  }
  return view;
}

// Names the pixel truth of a view that lies beside the plan's file.
void FindPixelTruth(const std::filesystem::path& folder, TruthView& view) {
  const std::string stem = std::filesystem::path(view.picture).stem().native();
  const auto find = [&](const char* kind, const char* extension) {
    const std::filesystem::path path = folder / kind / (stem + extension);
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) ? path : std::filesystem::path();
  };
  view.labels_path = find("labels", ".png");
  view.depth_path = find("depth", ".npy");
  view.normals_path = find("normals", ".npy");
}

std::string HashOf(const PlanCamera& camera, const PictureFiles& files,
                   const std::filesystem::path& folder) {
  if (!camera.sha256.empty()) return camera.sha256;
  const std::filesystem::path picture = files.Find(camera.picture, folder);
  return picture.empty() ? "" : Sha256OfFile(picture);
}

}  // namespace

GroundTruth ReadFloorplanTruth(const std::filesystem::path& path,
                               const std::filesystem::path& folder) {
  const Floorplan plan = ReadFloorplanJson(path);
  const PictureFiles files(folder);
  const HomeToWorld to_world(plan.home_from_world);
  GroundTruth truth;
  std::vector<TruthSegment> doors;
  for (size_t i = 0; i < plan.storeys.size(); ++i) {
    const std::vector<Cut> cuts = CutsOf(plan.storeys[i]);
    for (const Room& room : plan.storeys[i].rooms) {
      AppendRoom(room, static_cast<int>(i), cuts, to_world, truth);
    }
    const std::vector<size_t> first = FirstJoinedRooms(plan.storeys[i]);
    const std::vector<MultiPolygon2> passages = Passages(plan.storeys[i]);
    const size_t base = truth.rooms.size() - first.size();
    for (size_t k = 0; k < first.size(); ++k) {
      if (first[k] != k) truth.rooms[base + k].joined_to = base + first[k];
      for (const Polygon2& passage : passages[k])
        truth.rooms[base + k].passages.push_back({to_world(passage.outer), {}});
    }
    for (const Cut& cut : cuts) {
      if (cut.kind != OpeningKind::kDoor) continue;
      doors.push_back(to_world(
          TruthSegment{0.5 * (cut.near[0] + cut.far[0]), 0.5 * (cut.near[1] + cut.far[1])}));
    }
    for (const PlanCamera& camera : plan.cameras) {
      if (camera.storey_idx != static_cast<int>(i)) continue;
      truth.views.push_back(MakeView(camera, HashOf(camera, files, folder), plan.storeys[i], cuts,
                                     plan.home_from_world, to_world));
      FindPixelTruth(path.parent_path(), truth.views.back());
    }
  }
  truth.doors = MergeDoors(doors);
  return truth;
}

}  // namespace enfilade
