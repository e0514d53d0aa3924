// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/self_score.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/fixtures.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;

// A plan with what panoramas show where it is true.
struct Case {
  Floorplan plan;
  Scene scene;
  Structure structure;

  explicit Case(std::string_view text, const ProfileNoise& noise = {})
      : Case(TextHome(text, {.heading_rad = 0.3}), noise) {}
  Case(const Home& home, const ProfileNoise& noise)
      : plan(TruthFloorplan(home)),
        scene(FixtureScene(home)),
        structure(FixtureStructure(home, noise)) {}

  [[nodiscard]] PredictionFigures Score(size_t view = 0) const {
    return ScorePrediction(plan, scene.views[view], structure.profiles[view],
                           structure.home_from_world);
  }
};

constexpr const char* kRoom = "room 0,0 4,0 4,3 0,3 | camera 1.5,1.2";
constexpr const char* kTwoRooms =
    "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8 | "
    "camera 1.5,1.2 | camera 6,1.9";
constexpr const char* kCorner =
    "room 0,0 5,0 5,2 2,2 2,4 0,4 | camera 4,1";  // the far wing is out of sight

// Moves the wall x = from to x = to, in the polygon and in the walls.
void MoveWall(double from, double to, Storey& storey) {
  const auto move = [&](Vector2d& p) {
    if (std::abs(p.x() - from) < 1e-9) p.x() = to;
  };
  for (Room& room : storey.rooms) {
    for (Vector2d& p : room.polygon.outer) move(p);
  }
  for (Wall& wall : storey.walls) {
    move(wall.a);
    move(wall.b);
  }
}

TEST(ScorePrediction, ATruePlanPredictsAllThatIsShown) {
  for (const char* text : {kRoom, kTwoRooms, kCorner}) {
    const PredictionFigures figures = Case(text).Score();
    EXPECT_EQ(figures.floor_line, 1.0) << text;
    EXPECT_EQ(figures.ceiling_line, 1.0) << text;
    EXPECT_EQ(figures.vertical_lines, 1.0) << text;
    EXPECT_EQ(figures.depth, 1.0) << text;
    EXPECT_EQ(figures.score, 1.0) << text;
  }
}

TEST(ScorePrediction, DoesNotDependOnTheFrameOfThePlan) {
  Case turned(kCorner);
  MoveWall(5, 5.3, turned.plan.storeys[0]);
  const PredictionFigures before = turned.Score();
  const Eigen::Rotation2Dd turn(0.2);
  turned.plan.home_from_world.rotation = RotationZ(0.2) * turned.plan.home_from_world.rotation;
  turned.plan.home_from_world.translation =
      RotationZ(0.2) * turned.plan.home_from_world.translation;
  for (Room& room : turned.plan.storeys[0].rooms) {
    for (Vector2d& p : room.polygon.outer) p = turn * p;
  }
  for (Wall& wall : turned.plan.storeys[0].walls) {
    wall.a = turn * wall.a;
    wall.b = turn * wall.b;
  }
  EXPECT_EQ(turned.Score().depth, before.depth);
  EXPECT_EQ(turned.Score().vertical_lines, before.vertical_lines);
  EXPECT_LT(*before.depth, 1.0);
}

TEST(ScorePrediction, AMovedWallCostsThosePanoramasThatSeeIt) {
  Case home(kTwoRooms, {.are_doors_walls = true});
  home.plan.storeys[0].openings.clear();
  MoveWall(8, 8.3, home.plan.storeys[0]);
  EXPECT_EQ(home.Score(0).score, 1.0);
  // From (6, 1.9) the wall x = 8 spans these azimuths; of the walls beside it only what lies within
  // 30 cm of its ends was something else.
  const double share = (std::atan2(1.1, 2) + std::atan2(1.9, 2)) / (2 * kPi);
  EXPECT_NEAR(*home.Score(1).depth, 1 - share, 0.03);
  EXPECT_LT(*home.Score(1).floor_line, 1 - 0.5 * share);
  EXPECT_LT(*home.Score(1).score, 0.9);
}

TEST(ScorePrediction, TheWorseThePoseTheLowerTheScore) {
  double before = 1.01;
  for (const double off_m : {0.0, 0.1, 0.3, 0.6}) {
    Case home(kRoom);
    home.scene.views[0].world_from_cam.translation += Eigen::Vector3d(off_m, 0.5 * off_m, 0);
    const double score = *home.Score().score;
    EXPECT_LT(score, before - 0.005) << off_m;
    before = score;
  }
  EXPECT_LT(before, 0.5);
}

TEST(ScorePrediction, HeightsShowInTheirLinesAlone) {
  Case low(kRoom);
  low.plan.storeys[0].rooms[0].floor_z -= 0.15;
  EXPECT_LT(*low.Score().floor_line, 0.2);
  EXPECT_EQ(low.Score().ceiling_line, 1.0);
  EXPECT_EQ(low.Score().depth, 1.0);
  Case high(kRoom);
  high.plan.storeys[0].rooms[0].ceiling_z += 0.3;
  EXPECT_LT(*high.Score().ceiling_line, 0.2);
  EXPECT_EQ(high.Score().floor_line, 1.0);
}

TEST(ScorePrediction, SupposedWallsAndDoorsAreNoPrediction) {
  Case home(kTwoRooms);
  // Behind the open door something else is shown than any wall.
  WallProfile& profile = home.structure.profiles[0];
  const int num_columns = profile.num_columns();
  for (int c = 0; c < num_columns; ++c) {
    const double azimuth = AzimuthOfColumn(c, num_columns);
    const double y = 1.2 + 2.5 * std::tan(azimuth);
    if (std::cos(azimuth) > 0 && y > 1.05 && y < 1.75) profile.wall_m[static_cast<size_t>(c)] = 9;
  }
  EXPECT_EQ(home.Score().depth, 1.0);
  // A wall in a wrong place that the plan only supposes.
  MoveWall(0, -1, home.plan.storeys[0]);
  EXPECT_LT(*home.Score().depth, 0.9);
  for (Wall& wall : home.plan.storeys[0].walls) {
    if (wall.a.x() == -1 && wall.b.x() == -1) wall.seen = WallSeen::kInferred;
  }
  // Its neighbours are still predicted too long: at x −1 … 0 the wall x = 0 is shown.
  const double too_long =
      std::atan2(2.5, 1.2) - std::atan2(1.5, 1.2) + std::atan2(2.5, 1.8) - std::atan2(1.5, 1.8);
  const double left_out =
      std::atan2(1.2, 2.5) + std::atan2(1.8, 2.5) + std::atan2(0.6, 2.5) - std::atan2(-0.2, 2.5);
  EXPECT_NEAR(*home.Score().depth, 1 - too_long / (2 * kPi - left_out), 0.02);
  for (Wall& wall : home.plan.storeys[0].walls) wall.seen = WallSeen::kInferred;
  EXPECT_EQ(home.Score().score, std::nullopt);
}

TEST(ScorePrediction, NothingIsPredictedOutsideThePlan) {
  Case home(kTwoRooms);
  std::erase_if(home.plan.storeys[0].rooms, [](const Room& room) { return room.id == 0; });
  EXPECT_EQ(home.Score(0).score, std::nullopt);
  EXPECT_GT(*home.Score(1).score, 0.99);  // a column or two end on the door's reveal
  home.plan.storeys.clear();
  EXPECT_EQ(home.Score(1).score, std::nullopt);
}

TEST(ScorePrediction, UnseenColumnsAreNotJudged) {
  Case home(kRoom);
  WallProfile& profile = home.structure.profiles[0];
  for (size_t c = 0; c < 200; ++c) {
    profile.is_seen[c] = 0;
    profile.wall_m[c] = 17;
  }
  EXPECT_EQ(home.Score().depth, 1.0);
}

TEST(ScorePredictions, TakesTheMedianOfThosePredictedAndNamesTheWorstFirst) {
  const Case home(
      "room 0,0 4,0 4,3 0,3 | camera 1.5,1.2 | camera 2.5,1.2 | camera 2,2 | camera 1,2");
  Floorplan moved = home.plan, far = home.plan;
  MoveWall(4, 4.4, moved.storeys[0]);
  MoveWall(4, 6, far.storeys[0]);
  MoveWall(0, -1, far.storeys[0]);
  const std::vector<std::optional<Floorplan>> plans = {home.plan, moved, std::nullopt, far};
  const SelfReport report = ScorePredictions(home.scene, home.structure, plans);
  EXPECT_EQ(report.num_predicted, 3);
  EXPECT_EQ(report.panoramas[2].score, std::nullopt);
  EXPECT_EQ(report.score, report.panoramas[1].score);
  const std::string table = FormatSelfReport(report);
  size_t place = 0;
  for (const size_t view : {3, 1, 0, 2}) {
    const size_t next = table.find(home.scene.views[view].picture);
    EXPECT_GT(next, place) << table;
    place = next;
  }
  EXPECT_THAT(table, HasSubstr("3 of 4"));
  const nlohmann::json json = SelfReportToJson(report);
  EXPECT_EQ(json.at(0).at("score"), 1.0);
  EXPECT_TRUE(json.at(2).at("depth").is_null());
}

}  // namespace
}  // namespace enfilade
