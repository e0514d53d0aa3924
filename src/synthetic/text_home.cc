// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/text_home.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "enfilade/base/check.h"
#include "src/synthetic/cameras.h"
#include "src/synthetic/openings.h"
#include "src/synthetic/placement.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMaxThickness_m = 0.5;
constexpr double kOuterThickness_m = 0.28;
constexpr double kDoorHeight_m = 2.0;

// "kind x,y x,y … [height h]"
struct Part {
  std::string kind;
  Ring2 points;
  std::optional<double> height_m;
};

std::vector<Part> ParseParts(std::string_view text) {
  std::vector<Part> parts;
  std::istringstream stream{std::string(text)};
  std::string piece;
  while (std::getline(stream, piece, '|')) {
    std::istringstream words(piece);
    Part part;
    std::string points, word;
    words >> part.kind;
    while (words >> word && word != "height") points += word + " ";
    double height_m = 0;
    if (word == "height") {
      ENFILADE_CHECK_MSG(static_cast<bool>(words >> height_m), piece);
      part.height_m = height_m;
    }
    part.points = ParseRing(points);
    parts.push_back(part);
  }
  return parts;
}

int RoomAt(const Home& home, const Vector2d& p) {
  for (const HomeRoom& room : home.rooms) {
    if (Contains(room.polygon, p)) return room.id;
  }
  ENFILADE_CHECK_MSG(false, "no room at " + RingToText({p}));
}

void AddTextRoom(Home& home, const Part& part, const TextHomeOptions& options) {
  ENFILADE_CHECK(part.points.size() >= 3);
  HomeRoom room;
  room.id = static_cast<int>(home.rooms.size());
  room.polygon.outer = part.points;
  room.floor_z = options.floor_z;
  room.ceiling_z = options.floor_z + part.height_m.value_or(options.height_m);
  home.rooms.push_back(room);
}

// The room behind the opening, found across the wall.
void FindOtherRoom(const Home& home, HomeOpening& opening) {
  for (const HomeWall& wall : HomeWalls(home)) {
    const double thickness_m = wall.Inward().dot(wall.a - opening.a);
    if (wall.room_id == opening.room_id || wall.Inward().dot(opening.IntoWall()) < 1 - 1e-9)
      continue;
    if (thickness_m < 1e-6 || thickness_m > kMaxThickness_m) continue;
    HomeOpening candidate = opening;
    candidate.thickness_m = thickness_m;
    candidate.other_room_id = wall.room_id;
    if (OpeningOnWall(candidate, wall)) {
      opening = candidate;
      return;
    }
  }
}

void AddTextOpening(Home& home, const Part& part) {
  ENFILADE_CHECK_MSG(part.points.size() == 2, part.kind + " needs two points");
  for (const HomeWall& wall : HomeWalls(home)) {
    HomeOpening opening;
    opening.id = static_cast<int>(home.openings.size());
    const bool is_forward = wall.Along().dot(part.points[1] - part.points[0]) > 0;
    opening.a = part.points[is_forward ? 0 : 1];
    opening.b = part.points[is_forward ? 1 : 0];
    opening.room_id = wall.room_id;
    opening.thickness_m = kOuterThickness_m;
    if (!OpeningOnWall(opening, wall)) continue;
    const HomeRoom& room = home.RoomById(wall.room_id);
    opening.sill_z = room.floor_z;
    opening.head_z = std::min(room.floor_z + kDoorHeight_m, room.ceiling_z - 0.05);
    if (part.kind == "window") {
      opening.kind = OpeningKind::kWindow;
      opening.sill_z += 0.9;
    } else {
      FindOtherRoom(home, opening);
      if (part.kind == "opening") {
        opening.kind = OpeningKind::kOpening;
        opening.head_z = room.ceiling_z - 0.1;
      }
      if (part.kind == "closed") opening.leaf = DoorLeaf::kClosed;
    }
    home.openings.push_back(opening);
    return;
  }
  ENFILADE_CHECK_MSG(false, part.kind + " on no wall: " + RingToText(part.points));
}

void AddTextBox(Home& home, const Part& part) {
  ENFILADE_CHECK_MSG(part.points.size() == 2, "box needs two corners");
  HomeBox box;
  box.item = static_cast<int>(home.boxes.size());
  box.center = 0.5 * (part.points[0] + part.points[1]);
  box.size = (part.points[1] - part.points[0]).cwiseAbs();
  box.room_id = RoomAt(home, box.center);
  box.z0 = home.RoomById(box.room_id).floor_z;
  box.z1 = box.z0 + part.height_m.value_or(0.9);
  home.boxes.push_back(box);
}

void AddTextPart(Home& home, const Part& part, const TextHomeOptions& options) {
  if (part.kind == "room") {
    AddTextRoom(home, part, options);
  } else if (part.kind == "hole") {
    ENFILADE_CHECK(!home.rooms.empty());
    home.rooms.back().polygon.holes.push_back(part.points);
  } else if (part.kind == "box") {
    AddTextBox(home, part);
  } else if (part.kind == "camera") {
    ENFILADE_CHECK_MSG(part.points.size() == 1, "camera needs one point");
    const int room_id = RoomAt(home, part.points[0]);
    const double z = home.RoomById(room_id).floor_z + options.camera_height_m;
    // Headings differ, as they do in real captures.
    AddCamera(home, room_id, {part.points[0].x(), part.points[0].y(), z},
              0.7 * static_cast<double>(home.cameras.size()));
  } else {
    ENFILADE_CHECK_MSG(part.kind == "door" || part.kind == "closed" || part.kind == "opening" ||
                           part.kind == "window",
                       part.kind);
    AddTextOpening(home, part);
  }
}

}  // namespace

Home TextHome(std::string_view text, const TextHomeOptions& options) {
  Home home;
  home.baseboard_m = options.baseboard_m;
  home.home_from_world.rotation = RotationZ(-options.heading_rad);
  const std::vector<Part> parts = ParseParts(text);
  // Openings look for rooms on both sides: all rooms first.
  for (const bool is_room : {true, false}) {
    for (const Part& part : parts) {
      if ((part.kind == "room" || part.kind == "hole") == is_room) AddTextPart(home, part, options);
    }
  }
  ENFILADE_CHECK_MSG(!home.rooms.empty(), "no room");
  HangLamps(home, std::vector<float>(home.rooms.size(), 20.0f));
  if (home.cameras.empty()) {
    for (const HomeLamp& lamp : home.lamps) {
      const double z = home.RoomById(lamp.room_id).floor_z + options.camera_height_m;
      AddCamera(home, lamp.room_id, {lamp.center.x(), lamp.center.y(), z},
                0.7 * static_cast<double>(home.cameras.size()));
    }
  }
  return home;
}

}  // namespace enfilade
