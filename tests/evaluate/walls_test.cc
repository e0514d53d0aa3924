// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

WallFigures Judge(const std::vector<Ring2>& rooms) {
  return EvaluateWalls(JudgedPlanOf(MakePlan(rooms, SmallHomeDoors())),
                       JudgedPlanOf(MakeSmallHome().truth));
}

double TotalLength(const std::vector<Segment2>& walls) {
  double length = 0;
  for (const Segment2& wall : walls) length += (wall[1] - wall[0]).norm();
  return length;
}

TEST(EvaluateWalls, TruthAgainstItselfIsPerfect) {
  const WallFigures figures = Judge(SmallHomeRooms());
  EXPECT_NEAR(*figures.plan_to_truth_median_m, 0, 1e-9);
  EXPECT_NEAR(*figures.plan_to_truth_p95_m, 0, 1e-9);
  EXPECT_NEAR(*figures.truth_to_plan_median_m, 0, 1e-9);
  EXPECT_NEAR(*figures.truth_to_plan_p95_m, 0, 1e-9);
  EXPECT_EQ(figures.within_10cm, 1.0);
}

TEST(EvaluateWalls, AWallMovedBy7CentimetresShowsInTheTailAlone) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.17,0 8.17,3 4.1,3");
  const WallFigures figures = Judge(rooms);
  EXPECT_NEAR(*figures.plan_to_truth_median_m, 0, 1e-9);
  EXPECT_NEAR(*figures.plan_to_truth_p95_m, 0.07, 1e-9);  // 3 m of 44 m
  EXPECT_NEAR(*figures.truth_to_plan_p95_m, 0.07, 1e-9);
  EXPECT_EQ(figures.within_10cm, 1.0);
}

TEST(EvaluateWalls, AWallMovedBy20CentimetresIsNotWithinTen) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.3,0 8.3,3 4.1,3");
  const double length = TotalLength(MakeSmallHome().truth.walls);
  EXPECT_NEAR(*Judge(rooms).within_10cm, 1 - 3 / length, 1e-3);
}

TEST(EvaluateWalls, AMergedRoomLosesItsWallsOneWayOnly) {
  // Rooms 0 and 1 as one: both faces of the wall between them are gone.
  const std::vector<Ring2> rooms = {ParseRing("0,0 8.1,0 8.1,3 0,3"), SmallHomeRooms()[2]};
  const WallFigures figures = Judge(rooms);
  EXPECT_NEAR(*figures.plan_to_truth_p95_m, 0, 1e-9);
  EXPECT_GT(*figures.truth_to_plan_p95_m, 1);
  // Nothing of the two faces, 3 m each, has a parallel plan wall within 10 cm.
  const double length = TotalLength(MakeSmallHome().truth.walls);
  EXPECT_NEAR(*figures.within_10cm, 1 - 6 / length, 2e-3);
}

TEST(EvaluateWalls, APlanTurnedByOneDegreeAboutItsCorner) {
  // One room of 8 × 8 m, turned about the origin by 1°: a point s metres along either wall through
  // the origin is s · sin 1° off. The other two walls lie 8 m from the origin; along them the
  // offset runs from 8 · (1 − cos 1°) to 8 · sin 1°, so that every wall sweeps 0 … 14 cm evenly.
  const Ring2 square = ParseRing("0,0 8,0 8,8 0,8");
  Ring2 turned = square;
  for (Vector2d& p : turned) p = Eigen::Rotation2Dd(DegToRad(1)) * p;
  JudgedPlan plan, truth;
  plan.walls = OutlineOf({{turned, {}}});
  truth.walls = OutlineOf({{square, {}}});
  const WallFigures figures = EvaluateWalls(plan, truth);
  const double farthest_m = 8 * std::sin(DegToRad(1));
  EXPECT_NEAR(*figures.plan_to_truth_median_m, 0.5 * farthest_m, 0.002);
  EXPECT_NEAR(*figures.plan_to_truth_p95_m, 0.95 * farthest_m, 0.002);
  EXPECT_NEAR(*figures.truth_to_plan_median_m, 0.5 * farthest_m, 0.002);
  EXPECT_NEAR(*figures.within_10cm, 0.10 / farthest_m, 0.01);
}

TEST(EvaluateWalls, ASideWithoutWallsGivesNone) {
  const WallFigures figures = EvaluateWalls(JudgedPlan(), JudgedPlanOf(MakeSmallHome().truth));
  EXPECT_EQ(figures.plan_to_truth_median_m, std::nullopt);
  EXPECT_EQ(figures.within_10cm, std::nullopt);
}

TEST(WallDistances, WallsOfAnotherDirectionDoNotCount) {
  const std::vector<Segment2> along_x = {{Vector2d(0, 0), Vector2d(1, 0)}};
  const auto at_angle = [](double deg) {
    const double rad = DegToRad(deg);
    return std::vector<Segment2>{{Vector2d(0, 1), Vector2d(std::cos(rad), 1 + std::sin(rad))}};
  };
  EXPECT_TRUE(std::isfinite(WallDistances(along_x, at_angle(29))[0]));
  EXPECT_TRUE(std::isfinite(WallDistances(along_x, at_angle(180 + 29))[0]));
  EXPECT_TRUE(std::isinf(WallDistances(along_x, at_angle(31))[0]));
  EXPECT_TRUE(std::isinf(WallDistances(along_x, at_angle(90))[0]));
}

TEST(WallDistances, SamplesEveryCentimetreOfTheTotalLength) {
  const std::vector<Segment2> wall = {{Vector2d(0, 0), Vector2d(1, 0)}};
  EXPECT_EQ(WallDistances(wall, wall).size(), 100U);
  // Cut into steps of 3 mm the same wall has as many samples.
  std::vector<Segment2> steps;
  for (int i = 0; i < 300; ++i)
    steps.push_back({Vector2d(i * 0.003, 0), Vector2d((i + 1) * 0.003, 0)});
  EXPECT_NEAR(static_cast<double>(WallDistances(steps, wall).size()), 90, 1);
}

// The twin: for every sample every segment, by minimising over points along it.
double SlowDistance(const Vector2d& p, const std::vector<Segment2>& walls, double angle_rad) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment2& wall : walls) {
    const Vector2d d = wall[1] - wall[0];
    if (std::abs(2 * WrapQuarter(0.5 * (std::atan2(d.y(), d.x()) - angle_rad))) >
        kMaxWallAngle_rad) {
      continue;
    }
    for (int i = 0; i <= 2000; ++i)
      nearest = std::min(nearest, (wall[0] + i / 2000.0 * d - p).norm());
  }
  return nearest;
}

TEST(WallDistances, AgreesWithItsBruteForceTwin) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 10);
  const auto random_walls = [&](int count) {
    std::vector<Segment2> walls;
    for (int i = 0; i < count; ++i) {
      walls.push_back(
          {Vector2d(place(random), place(random)), Vector2d(place(random), place(random))});
    }
    return walls;
  };
  const std::vector<Segment2> to = random_walls(12);
  for (const Segment2& wall : random_walls(6)) {
    const std::vector<double> distances = WallDistances({wall}, to);
    const Vector2d direction = (wall[1] - wall[0]).normalized();
    const double angle = std::atan2(direction.y(), direction.x());
    for (size_t i = 0; i < distances.size(); i += 37) {
      const Vector2d p = wall[0] + (static_cast<double>(i) + 0.5) * kWallSample_m * direction;
      EXPECT_NEAR(distances[i], SlowDistance(p, to, angle), 0.01);
    }
  }
}

}  // namespace
}  // namespace enfilade
