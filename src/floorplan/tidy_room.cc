// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/tidy_room.h"

#include "src/floorplan/box_index.h"
#include "src/floorplan/sound_polygon.h"

namespace enfilade {
namespace {

constexpr double kCollinear_m = 1e-6;

bool OverlapsOthers(const Polygon2& polygon, std::optional<size_t> own,
                    const std::vector<Polygon2>& rooms) {
  const Box2 bounds = BoxOf(polygon.outer);
  for (size_t i = 0; i < rooms.size(); ++i) {
    if (i == own || !bounds.intersects(BoxOf(rooms[i].outer))) continue;
    if (Area(Intersection({polygon}, {rooms[i]})) > kMaxOverlap_m2) return true;
  }
  return false;
}

}  // namespace

Polygon2 TidyRoom(const MultiPolygon2& region, double min_jog_m, const WallWeight& weight,
                  std::optional<size_t> own, const std::vector<Polygon2>& rooms) {
  const Polygon2 part = LargestRoom(region, kCollinear_m);
  Polygon2 tidy = part;
  StraightenJogs(min_jog_m, weight, tidy);
  if (!OverlapsOthers(tidy, own, rooms)) return tidy;
  return OverlapsOthers(part, own, rooms) ? Polygon2{} : part;
}

}  // namespace enfilade
