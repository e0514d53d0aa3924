// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/floorplan_checks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/geometry/boolean.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/box_index.h"

namespace enfilade {
namespace {

constexpr double kTolerance_m = 1e-6;
constexpr double kMaxOverlap_m2 = 1e-6;

void ExpectValidPolygon(const Polygon2& polygon) {
  EXPECT_TRUE(IsSimple(polygon.outer)) << RingToText(polygon.outer);
  EXPECT_GT(SignedArea(polygon.outer), 0);
  double holes_m2 = 0;
  for (const Ring2& hole : polygon.holes) {
    EXPECT_TRUE(IsSimple(hole)) << RingToText(hole);
    EXPECT_LT(SignedArea(hole), 0);
    holes_m2 -= SignedArea(hole);
    for (const Eigen::Vector2d& p : hole) EXPECT_TRUE(Contains(polygon.outer, p)) << "hole outside";
  }
  EXPECT_GT(Area(polygon), 0);
  // Overlapping holes would be counted twice.
  EXPECT_NEAR(Area(Union({polygon})), SignedArea(polygon.outer) - holes_m2, kMaxOverlap_m2);
}

/// The walls of the room in order must be the edges of its rings in order.
void ExpectWallsAreEdges(const Storey& storey, const Room& room) {
  std::vector<const Wall*> walls;
  for (const Wall& wall : storey.walls) {
    if (wall.room_id == room.id) walls.push_back(&wall);
  }
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges;
  const auto add_ring = [&](const Ring2& ring) {
    for (size_t i = 0; i < ring.size(); ++i)
      edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  };
  add_ring(room.polygon.outer);
  for (const Ring2& hole : room.polygon.holes) add_ring(hole);
  ASSERT_EQ(walls.size(), edges.size()) << "room " << room.id;
  for (size_t i = 0; i < edges.size(); ++i) {
    EXPECT_LT((walls[i]->a - edges[i].first).norm(), kTolerance_m) << "wall " << walls[i]->id;
    EXPECT_LT((walls[i]->b - edges[i].second).norm(), kTolerance_m) << "wall " << walls[i]->id;
  }
}

void ExpectValidStorey(const Storey& storey) {
  std::vector<Box2> boxes;
  for (const Room& room : storey.rooms) boxes.push_back(BoxOf(room.polygon.outer));
  for (size_t i = 0; i < storey.rooms.size(); ++i) {
    const Room& room = storey.rooms[i];
    SCOPED_TRACE(testing::Message() << "room " << room.id);
    ExpectValidPolygon(room.polygon);
    EXPECT_GT(room.ceiling_z, room.floor_z);
    EXPECT_TRUE(std::isfinite(room.area_sigma_m2) && room.area_sigma_m2 >= 0);
    MultiPolygon2 taken;
    for (size_t j = 0; j < i; ++j) {
      if (boxes[j].intersects(boxes[i])) taken.push_back(storey.rooms[j].polygon);
    }
    EXPECT_LT(Area(Intersection({room.polygon}, taken)), kMaxOverlap_m2) << "rooms overlap";
    ExpectWallsAreEdges(storey, room);
  }
  for (size_t i = 0; i < storey.walls.size(); ++i) {
    const Wall& wall = storey.walls[i];
    EXPECT_EQ(wall.id, static_cast<int>(i));
    EXPECT_GT((wall.b - wall.a).norm(), kTolerance_m);
    EXPECT_GT(wall.thickness_m, 0);
    EXPECT_TRUE(std::isfinite(wall.sigma_m) && wall.sigma_m >= 0);
  }
  for (const Opening& opening : storey.openings) {
    ASSERT_GE(opening.wall_id, 0);
    ASSERT_LT(static_cast<size_t>(opening.wall_id), storey.walls.size());
    const Wall& wall = storey.walls[static_cast<size_t>(opening.wall_id)];
    EXPECT_LT(DistanceToSegment(opening.a, wall.a, wall.b), 1e-3);
    EXPECT_LT(DistanceToSegment(opening.b, wall.a, wall.b), 1e-3);
    EXPECT_GT(opening.head_z, opening.sill_z);
  }
}

}  // namespace

void ExpectValidFloorplan(const Floorplan& plan) {
  for (const Storey& storey : plan.storeys) {
    SCOPED_TRACE(testing::Message() << "storey " << storey.id);
    ExpectValidStorey(storey);
  }
}

}  // namespace enfilade
