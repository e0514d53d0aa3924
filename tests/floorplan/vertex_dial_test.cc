// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/vertex_dial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

OutlineChoice Choice(const char* ring, double cost_m) {
  OutlineChoice choice{cost_m, {ParseRing(ring), {}}, {}, {}};
  choice.seen.assign(choice.polygon.outer.size(), WallSeen::kPartly);
  choice.sigma_m.assign(choice.polygon.outer.size(), 0.02);
  return choice;
}

// Two rooms with curves and one without; the first has six corners, the others four.
Floorplan ThreeRooms() {
  Floorplan plan;
  Storey& storey = plan.storeys.emplace_back();
  for (int id = 0; id < 3; ++id) {
    Room& room = storey.rooms.emplace_back();
    room.id = id;
    room.ceiling_z = 2.4;
  }
  storey.rooms[0].curve = {Choice("0,0 4,0 4,3 0,3", 5), Choice("0,0 4,0 4,3 2,3 2,2 0,2", 1),
                           Choice("0,0 4,0 4,3 2,3 2,2 1,2 1,1 0,1", 0.5)};
  storey.rooms[2].curve = {Choice("10,0 14,0 14,3 10,3", 2),
                           Choice("10,0 14,0 14,3 12,3 12,2 10,2", 0)};
  TakeOutline(storey.rooms[0].curve[1], 0.1, storey.rooms[0], storey);
  TakeOutline(Choice("5,0 9,0 9,3 5,3", 0), 0.2, storey.rooms[1], storey);
  TakeOutline(storey.rooms[2].curve[0], 0.3, storey.rooms[2], storey);
  Opening door;
  door.wall_id = storey.walls[7].id;
  door.a = {9, 1};
  door.b = {9, 1.8};
  door.room_id = 1;
  door.head_z = 2;
  storey.openings.push_back(door);
  return plan;
}

TEST(VertexDial, TellsTheNumbersThatTheCurvesAllowTogether) {
  EXPECT_THAT(VertexNumbers(ThreeRooms()), ElementsAre(8, 10, 12, 14));
  EXPECT_THAT(VertexNumbers({}), IsEmpty());
}

TEST(VertexDial, GivesCornersWhereTheyCostLeast) {
  const Floorplan plan = ThreeRooms();
  ExpectValidFloorplan(plan);
  const std::vector<std::pair<int, std::array<size_t, 2>>> expected = {
      {8, {4, 4}}, {10, {6, 4}}, {12, {6, 6}}, {14, {8, 6}}};
  for (const auto& [number, corners] : expected) {
    SCOPED_TRACE(number);
    const auto dialled = PlanWithVertices(plan, number);
    ASSERT_TRUE(dialled);
    ExpectValidFloorplan(*dialled);
    const Storey& storey = dialled->storeys[0];
    EXPECT_EQ(storey.rooms[0].polygon.outer.size(), corners[0]);
    EXPECT_EQ(storey.rooms[2].polygon.outer.size(), corners[1]);
    EXPECT_EQ(storey.walls.size(), corners[0] + 4 + corners[1]);
    EXPECT_EQ(storey.walls.back().thickness_m, 0.3);
    EXPECT_EQ(storey.rooms[0].curve.size(), 3u) << "the curve stays";
    EXPECT_EQ(storey.walls.at(static_cast<size_t>(storey.openings[0].wall_id)).room_id, 1);
  }
}

TEST(VertexDial, NamesTheNearestNumber) {
  const Floorplan plan = ThreeRooms();
  EXPECT_FALSE(PlanWithVertices(plan, 9));
  EXPECT_FALSE(PlanWithVertices(plan, 1000));
  EXPECT_FALSE(PlanWithVertices({}, 4));
  EXPECT_THAT(WhyNoSuchNumber(plan, 1000), HasSubstr("the nearest has 14 (of 8 to 14)"));
  EXPECT_THAT(WhyNoSuchNumber({}, 4), HasSubstr("no curve"));
}

}  // namespace
}  // namespace enfilade
