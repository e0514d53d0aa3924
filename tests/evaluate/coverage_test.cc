// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/coverage.h"

#include <gtest/gtest.h>

#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

CoverageFigures Judge(const Floorplan& plan) {
  return EvaluateCoverage(plan, JudgedPlanOf(MakeSmallHome().truth));
}

TEST(EvaluateCoverage, TruthAgainstItselfIsCovered) {
  const CoverageFigures figures = Judge(MakeSmallHome().plan);
  EXPECT_EQ(figures.all.num_walls, 12);
  EXPECT_EQ(figures.all.sigma1, 1.0);
  EXPECT_EQ(figures.all.sigma2, 1.0);
  EXPECT_EQ(figures.seen.num_walls, 4);
  EXPECT_EQ(figures.partly.num_walls, 4);
  EXPECT_EQ(figures.inferred.num_walls, 4);
  EXPECT_EQ(figures.inferred.sigma1, 1.0);
}

TEST(EvaluateCoverage, AWallCountsByItsOwnDeviation) {
  // The right wall of room 1 is 7 cm off; wall 5 is inferred.
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.17,0 8.17,3 4.1,3");
  Floorplan plan = MakePlan(rooms, SmallHomeDoors());
  const auto judge = [&](double sigma_m) {
    plan.storeys[0].walls[5].sigma_m = sigma_m;
    return Judge(plan);
  };
  EXPECT_NEAR(*judge(0.071).all.sigma1, 1, 1e-12);
  EXPECT_NEAR(*judge(0.069).all.sigma1, 11.0 / 12, 1e-12);
  EXPECT_NEAR(*judge(0.036).all.sigma2, 1, 1e-12);
  EXPECT_NEAR(*judge(0.034).all.sigma2, 11.0 / 12, 1e-12);
  EXPECT_EQ(judge(0.034).inferred.sigma2, 0.75);
  EXPECT_EQ(judge(0.034).seen.sigma2, 1.0);
  EXPECT_EQ(judge(0).all.num_walls, 11);  // without a deviation
}

TEST(EvaluateCoverage, AWallWithoutTrueWallIsNotCovered) {
  Floorplan plan = MakeSmallHome().plan;
  for (Wall& wall : plan.storeys[0].walls) {
    wall.b = wall.a + Eigen::Rotation2Dd(0.25 * 3.14159) * (wall.b - wall.a);
  }
  EXPECT_EQ(Judge(plan).all.sigma2, 0.0);
}

TEST(EvaluateCoverage, NothingToJudgeGivesNone) {
  EXPECT_EQ(Judge(Floorplan()).all.sigma1, std::nullopt);
  EXPECT_EQ(EvaluateCoverage(MakeSmallHome().plan, JudgedPlan()).all.sigma1, std::nullopt);
}

}  // namespace
}  // namespace enfilade
