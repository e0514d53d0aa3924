// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <utility>

#include "enfilade/base/errors.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/geometry/boolean.h"
#include "src/exchange/json_geometry.h"
#include "src/exchange/picture_files.h"
#include "src/exchange/truth_sources.h"
#include "src/exchange/zind.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

// Doors are annotated on the outline that they belong to; layouts of one room differ by
// millimetres.
constexpr double kDoorToWall_m = 0.15;
// The layouts of a room's panoramas are one polygon carried over with rounding.
constexpr double kSameVertex_m = 0.005;

struct ZindLayout {
  Ring2 ring;
  std::vector<TruthSegment> doors, openings;
};

// Doors, windows and openings come as three rows each: left, right, (bottom, top).
std::vector<TruthSegment> ReadSegments(const ZindTour& tour, const ZindPanorama& panorama,
                                       const Json& layout, const char* key,
                                       const std::string& where) {
  std::vector<TruthSegment> segments;
  if (!layout.contains(key)) return segments;
  const std::string what = std::string(key) + " of '" + panorama.image_path + "'";
  const Ring2 rows = RingFromJson(layout[key], where, what);
  if (rows.size() % 3 != 0) {
    throw InvalidInputError(where, what + " are not three rows each",
                            "check that the file is complete");
  }
  for (size_t i = 0; i < rows.size(); i += 3) {
    segments.push_back(
        {tour.WorldFromLocal(panorama, rows[i]), tour.WorldFromLocal(panorama, rows[i + 1])});
  }
  return segments;
}

// The first of the named layouts that the panorama has; an empty ring when there is none.
ZindLayout ReadLayout(const ZindTour& tour, const ZindPanorama& panorama,
                      std::initializer_list<const char*> names, const std::string& where) {
  ZindLayout layout;
  for (const char* name : names) {
    const auto it = panorama.annotation->find(name);
    if (it == panorama.annotation->end() || !it->is_object()) continue;
    const Json& vertices = JsonArray(*it, "vertices", where);
    const std::string what = std::string(name) + " of '" + panorama.image_path + "'";
    for (const Eigen::Vector2d& vertex : RingFromJson(vertices, where, what)) {
      layout.ring.push_back(tour.WorldFromLocal(panorama, vertex));
    }
    layout.doors = ReadSegments(tour, panorama, *it, "doors", where);
    layout.openings = ReadSegments(tour, panorama, *it, "openings", where);
    break;
  }
  if (SignedArea(layout.ring) < 0) std::reverse(layout.ring.begin(), layout.ring.end());
  return layout;
}

// One room while its panoramas are gathered.
struct RoomParts {
  MultiPolygon2 layouts;
  std::vector<TruthSegment> doors, openings;
  std::vector<double> ceiling_m;  // above the floor
  bool is_flat = true;
  double floor_z = 0;
  int storey_idx = 0;
};

void GatherPanorama(const ZindTour& tour, const ZindPanorama& panorama, const std::string& where,
                    RoomParts& room) {
  const ZindLayout layout = ReadLayout(tour, panorama, {"layout_complete", "layout_raw"}, where);
  if (layout.ring.size() >= 3) room.layouts.push_back({layout.ring, {}});
  room.doors.insert(room.doors.end(), layout.doors.begin(), layout.doors.end());
  room.openings.insert(room.openings.end(), layout.openings.begin(), layout.openings.end());
  const Json& annotation = *panorama.annotation;
  if (annotation.contains("ceiling_height") && !annotation["ceiling_height"].is_null()) {
    room.ceiling_m.push_back(JsonNumber(annotation, "ceiling_height", where) *
                             tour.MetresPerLocal(panorama));
  }
  const auto flat = annotation.find("is_ceiling_flat");
  if (flat != annotation.end() && flat->is_boolean() && !flat->get<bool>()) room.is_flat = false;
  room.floor_z = tour.floors[static_cast<size_t>(panorama.floor_idx)].floor_z;
  room.storey_idx = panorama.floor_idx;
}

TruthRoom MakeRoom(RoomParts& parts) {
  TruthRoom room;
  room.region = Union(parts.layouts);
  for (Polygon2& polygon : room.region) {
    polygon.outer = RemoveCollinear(polygon.outer, kSameVertex_m);
    for (Ring2& hole : polygon.holes) hole = RemoveCollinear(hole, kSameVertex_m);
    std::erase_if(polygon.holes, [](const Ring2& hole) { return hole.size() < 3; });
  }
  std::erase_if(room.region, [](const Polygon2& polygon) { return polygon.outer.size() < 3; });
  room.storey_idx = parts.storey_idx;
  room.floor_z = parts.floor_z;
  if (parts.is_flat && !parts.ceiling_m.empty()) {
    std::sort(parts.ceiling_m.begin(), parts.ceiling_m.end());
    room.ceiling_z = parts.floor_z + parts.ceiling_m[parts.ceiling_m.size() / 2];
  }
  return room;
}

TruthView MakeView(const ZindTour& tour, const ZindPanorama& panorama, const PictureFiles& files,
                   const std::filesystem::path& path) {
  const std::string& where = path.native();
  TruthView view;
  view.picture = std::filesystem::path(panorama.image_path).filename().native();
  const std::filesystem::path picture = files.Find(panorama.image_path, path.parent_path());
  if (!picture.empty()) view.sha256 = Sha256OfFile(picture);
  view.storey_idx = panorama.floor_idx;
  view.world_from_cam = tour.WorldFromCam(panorama);
  const auto inside = panorama.annotation->find("is_inside");
  view.is_inside = inside == panorama.annotation->end() || *inside != Json(false);
  view.camera_height_m = tour.MetresPerLocal(panorama) * panorama.camera_height;
  ZindLayout layout = ReadLayout(tour, panorama, {"layout_visible", "layout_raw"}, where);
  view.visible_layout = std::move(layout.ring);
  view.doors = std::move(layout.doors);
  view.openings = std::move(layout.openings);
  return view;
}

}  // namespace

GroundTruth ReadZindTruth(const std::filesystem::path& path, double camera_height_m) {
  const ZindTour tour = ReadZindTour(path, camera_height_m);
  const PictureFiles files(path.parent_path());
  std::map<std::pair<int, std::string>, RoomParts> rooms;  // by floor and complete room
  GroundTruth truth;
  for (const ZindPanorama& panorama : tour.panoramas) {
    GatherPanorama(tour, panorama, path.native(), rooms[{panorama.floor_idx, panorama.group}]);
    truth.views.push_back(MakeView(tour, panorama, files, path));
  }
  std::vector<TruthSegment> doors;
  for (auto& [key, parts] : rooms) {
    truth.rooms.push_back(MakeRoom(parts));
    std::vector<TruthSegment> gaps = parts.doors;
    gaps.insert(gaps.end(), parts.openings.begin(), parts.openings.end());
    const auto walls = CutGaps(truth.rooms.back().region, gaps, kDoorToWall_m);
    truth.walls.insert(truth.walls.end(), walls.begin(), walls.end());
    doors.insert(doors.end(), parts.doors.begin(), parts.doors.end());
  }
  truth.doors = MergeDoors(doors);
  return truth;
}

}  // namespace enfilade
