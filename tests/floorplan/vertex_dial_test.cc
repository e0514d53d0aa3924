// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/vertex_dial.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "src/floorplan/wall_thickness.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kMaxWall_m = 0.45;

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
    const auto dialled = PlanWithVertices(plan, number, kMaxWall_m);
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

TEST(VertexDial, NamesTheNearestNumbers) {
  const Floorplan plan = ThreeRooms();
  EXPECT_FALSE(PlanWithVertices(plan, 9, kMaxWall_m));
  EXPECT_FALSE(PlanWithVertices(plan, 1000, kMaxWall_m));
  EXPECT_FALSE(PlanWithVertices({}, 4, kMaxWall_m));
  EXPECT_THAT(WhyNoSuchNumber(plan, 1000), HasSubstr("the nearest has 14 (of 8 to 14)"));
  EXPECT_THAT(WhyNoSuchNumber(plan, 9), HasSubstr("the nearest have 8 and 10 (of 8 to 14)"));
  EXPECT_THAT(WhyNoSuchNumber(plan, -2147483647), HasSubstr("the nearest has 8"));
  EXPECT_THAT(WhyNoSuchNumber({}, 4), HasSubstr("no curve"));
}

// A curve of any outlines with these corners and costs.
std::vector<OutlineChoice> CurveOf(const std::vector<std::pair<int, double>>& corners_and_costs) {
  std::vector<OutlineChoice> curve;
  for (const auto& [corners, cost_m] : corners_and_costs) {
    OutlineChoice& choice = curve.emplace_back();
    choice.cost_m = cost_m;
    for (int i = 0; i < corners; ++i) choice.polygon.outer.emplace_back(std::cos(i), std::sin(i));
    choice.seen.assign(static_cast<size_t>(corners), WallSeen::kSeen);
    choice.sigma_m.assign(static_cast<size_t>(corners), 0.02);
  }
  return curve;
}

TEST(VertexDial, IsTheBestOfAllCombinationsAndTheBoundIsBelow) {
  constexpr double kRounding = 1e-5;  // costs are rounded to micrometres, room by room
  std::mt19937 random(3);
  int num_tight = 0, num_plans = 0;
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    Floorplan plan;
    Storey& storey = plan.storeys.emplace_back();
    std::map<int, double> best = {{0, 0}};
    for (int r = 0; r < 2 + round % 4; ++r) {
      std::vector<std::pair<int, double>> entries;
      int corners = 3 + static_cast<int>(random() % 3);
      double cost = 0.25 * static_cast<double>(random() % 80);
      for (size_t i = 0; i < 1 + random() % 5; ++i) {
        entries.emplace_back(corners, cost);
        corners += 1 + static_cast<int>(random() % 3);
        cost *= 0.25 * static_cast<double>(random() % 4);
      }
      Room& room = storey.rooms.emplace_back();
      room.id = r;
      room.curve = CurveOf(entries);
      TakeOutline(room.curve.back(), 0.1, room, storey);
      std::map<int, double> next;
      for (const auto& [number, sum] : best) {
        for (const auto& [more, price] : entries) {
          const auto [entry, is_new] = next.try_emplace(number + more, sum + price);
          entry->second = std::min(entry->second, sum + price);
        }
      }
      best = next;
    }
    std::vector<int> numbers;
    for (const auto& [number, cost] : best) {
      numbers.push_back(number);
      const auto dialled = PlanWithVertices(plan, number, kMaxWall_m);
      ASSERT_TRUE(dialled && dialled->dial);
      int num_corners = 0;
      for (const Room& room : dialled->storeys[0].rooms)
        num_corners += static_cast<int>(room.polygon.outer.size());
      EXPECT_EQ(num_corners, number);
      EXPECT_EQ(dialled->dial->num_vertices, number);
      EXPECT_NEAR(dialled->dial->cost_m, cost, kRounding);
      EXPECT_LE(dialled->dial->bound_m, cost + kRounding);
      num_tight += dialled->dial->bound_m > cost - kRounding;
      ++num_plans;
    }
    EXPECT_EQ(VertexNumbers(plan), numbers);
    EXPECT_NEAR(PlanWithVertices(plan, numbers.front(), kMaxWall_m)->dial->bound_m,
                best.begin()->second, kRounding);
  }
  EXPECT_GT(num_tight, num_plans / 3);
}

// A room with an alcove of 2 m x 0.3 m at its far side, a corridor behind it, and doors and
// windows: 0 in the alcove to the corridor, 1 beside the alcove, 2 in its short side, 3 in the
// other room.
Floorplan RoomWithAlcove() {
  Floorplan plan;
  Storey& storey = plan.storeys.emplace_back();
  for (int id = 0; id < 2; ++id) {
    Room& room = storey.rooms.emplace_back();
    room.id = id;
    room.ceiling_z = 2.4;
  }
  const OutlineChoice as_drawn = Choice("0,0 5,0 5,3 4,3 4,3.3 2,3.3 2,3 0,3", 0);
  storey.rooms[0].curve = {Choice("0,0 5,0 5,3 0,3", 4), as_drawn};
  TakeOutline(as_drawn, 0.1, storey.rooms[0], storey);
  TakeOutline(Choice("0,3.4 5,3.4 5,5 0,5", 0), 0.2, storey.rooms[1], storey);
  for (Wall& wall : storey.walls) wall.length_sigma_m = 0.01;
  MeasureThickness(kMaxWall_m, storey);
  const auto add = [&](int wall_id, const Vector2d& a, const Vector2d& b) {
    Opening& opening = storey.openings.emplace_back();
    opening.id = static_cast<int>(storey.openings.size()) - 1;
    opening.wall_id = wall_id;
    opening.a = a;
    opening.b = b;
    opening.head_z = 2;
    opening.room_id = storey.walls[static_cast<size_t>(wall_id)].room_id;
  };
  add(4, {3.2, 3.3}, {2.4, 3.3});
  add(6, {1.6, 3}, {0.8, 3});
  add(5, {2, 3.25}, {2, 3.05});
  add(10, {4, 5}, {3, 5});
  ExpectValidFloorplan(plan);
  return plan;
}

TEST(VertexDial, OpeningsMoveToTheNearestWallOrAreDropped) {
  const Floorplan plan = RoomWithAlcove();
  const std::optional<Floorplan> dialled = PlanWithVertices(plan, 4, kMaxWall_m);
  ASSERT_TRUE(dialled);
  ExpectValidFloorplan(*dialled);
  const Storey& storey = dialled->storeys[0];
  ASSERT_EQ(storey.openings.size(), 3U);
  EXPECT_EQ(storey.openings[0].a, Vector2d(3.2, 3)) << "moved out of the alcove";
  EXPECT_EQ(storey.openings[0].b, Vector2d(2.4, 3));
  EXPECT_EQ(storey.openings[0].wall_id, 2);
  EXPECT_EQ(storey.openings[1].a, Vector2d(1.6, 3)) << "still on its line";
  EXPECT_EQ(storey.openings[1].wall_id, 2);
  EXPECT_EQ(storey.openings[2].a, Vector2d(4, 5)) << "in the room that stays";
  EXPECT_EQ(storey.openings[2].wall_id, 6);
  ASSERT_TRUE(dialled->dial);
  EXPECT_EQ(dialled->dial->num_openings_dropped, 1);
  EXPECT_THAT(TellDial(*dialled->dial), HasSubstr("dropped: 1"));
}

TEST(VertexDial, ADoorThatFindsItsPlaceTakenIsDropped) {
  Floorplan plan = RoomWithAlcove();
  std::vector<Opening>& openings = plan.storeys[0].openings;
  openings[0].a = {2.8, 3.3};
  openings[0].b = {2, 3.3};
  openings[1].a = {2, 3};
  openings[1].b = {1.2, 3};
  plan.storeys[0].rooms[0].curve[0] = Choice("0,0 5,0 5,2.5 2.6,2.5 2.6,3 0,3", 4);
  const std::optional<Floorplan> apart = PlanWithVertices(plan, 6, kMaxWall_m);
  ASSERT_TRUE(apart);
  ExpectValidFloorplan(*apart);
  EXPECT_EQ(apart->dial->num_openings_dropped, 2) << "that in the short wall, and one of the two";
}

TEST(VertexDial, NewWallsAreMeasured) {
  const Floorplan plan = RoomWithAlcove();
  const Storey storey = PlanWithVertices(plan, 4, kMaxWall_m)->storeys[0];
  EXPECT_EQ(storey.walls[2].other_room_id, 1);
  EXPECT_NEAR(storey.walls[2].thickness_m, 0.4, 1e-9);
  EXPECT_EQ(storey.walls[0].other_room_id, std::nullopt);
  EXPECT_NEAR(storey.walls[0].thickness_m, 0.1, 1e-9);
  EXPECT_NEAR(storey.walls[4].thickness_m, 0.4, 1e-9) << "its far side has moved";
  EXPECT_NEAR(storey.walls[0].length_sigma_m, 0.02 * std::sqrt(2), 1e-9);
  EXPECT_EQ(storey.walls[5].length_sigma_m, 0.01) << "as drawn";
}

std::string TextOf(const Floorplan& plan) {
  std::string text;
  for (const Storey& storey : plan.storeys) {
    for (const Room& room : storey.rooms)
      text += fmt::format("{} {} {:.6f}\n", room.id, RingToText(room.polygon.outer),
                          room.area_sigma_m2);
    for (const Wall& wall : storey.walls) {
      text += fmt::format(
          "{} {} {} {} {:.6f} {:.6f} {:.6f}\n", wall.id, RingToText({wall.a, wall.b}), wall.room_id,
          wall.other_room_id.value_or(-1), wall.thickness_m, wall.sigma_m, wall.length_sigma_m);
    }
    for (const Opening& opening : storey.openings)
      text += fmt::format("{} {} {}\n", opening.id, opening.wall_id,
                          RingToText({opening.a, opening.b}));
  }
  return text;
}

TEST(VertexDial, ComesBackWhereverItStoodBefore) {
  const Floorplan plan = RoomWithAlcove();
  const Floorplan few = *PlanWithVertices(plan, 4, kMaxWall_m);
  EXPECT_NE(TextOf(few), TextOf(plan));
  EXPECT_EQ(few.drawn_storeys.size(), 1U);
  EXPECT_TRUE(few.drawn_storeys[0].rooms[0].curve.empty());
  const Floorplan back = *PlanWithVertices(few, 8, kMaxWall_m);
  EXPECT_EQ(TextOf(back), TextOf(plan)) << "with its openings";
  EXPECT_TRUE(back.drawn_storeys.empty());
  EXPECT_EQ(back.storeys[0].rooms[0].curve.size(), 2U);
  EXPECT_EQ(TextOf(*PlanWithVertices(few, 4, kMaxWall_m)), TextOf(few));
  EXPECT_EQ(TextOf(*PlanWithVertices(plan, 8, kMaxWall_m)), TextOf(plan));
}

}  // namespace
}  // namespace enfilade
