// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/explain_wall.h"

#include <gtest/gtest.h>

#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/loop_field.h"
#include "src/floorplan/outline_cost.h"
#include "tests/floorplan/drawn_evidence.h"
#include "tests/floorplan/seen_plan.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

WallExplanation Explain(const SeenPlan& home, size_t wall_idx) {
  return ExplainWall(home.scene, home.structure, home.evidence, {}, home.plan, 0, wall_idx);
}

// The loop solver's own costs of the same steps, in its units.
TEST(AddEdgeCost, EqualsTheStepsOfTheLoopSolver) {
  const LoopField field =
      MakeLoopField(DrawEvidence({Box(0, 0, 2, 1.5)}, {.face_blur_m = 0.03, .noise = 0.4}), {});
  GridLoopProblem layout;
  layout.rows = field.frame.rows;
  layout.cols = field.frame.cols;
  const auto at = [&](int row, int col) {
    return Vector2d(field.frame.origin + field.frame.cell_m * Vector2d(col, row));
  };
  const int row = layout.rows / 3, col = layout.cols / 4, num_steps = layout.cols / 3;
  double east = 0, west = 0;
  for (int k = 0; k < num_steps; ++k) {
    east += field.step_cost[layout.StepIndex(row, col + k, GridHeading::kEast)];
    west += field.step_cost[layout.StepIndex(row, col + k + 1, GridHeading::kWest)];
  }
  OutlineCost eastwards, westwards;
  AddEdgeCost(field, {}, at(row, col), at(row, col + num_steps), eastwards);
  AddEdgeCost(field, {}, at(row, col + num_steps), at(row, col), westwards);
  EXPECT_NEAR(eastwards.total_m, east / kCostPerMetre, 0.001 * num_steps);
  EXPECT_NEAR(westwards.total_m, west / kCostPerMetre, 0.001 * num_steps);
}

TEST(ExplainWall, TellsWhoSeesItWhatLiesBehindAndTheOpeningsOnIt) {
  SeenPlan home = MakeSeenPlan(0, true);
  const WallExplanation why = Explain(home, home.partition);
  EXPECT_EQ(why.wall.id, 1);
  ASSERT_EQ(why.witnesses.size(), 1U);
  EXPECT_EQ(why.witnesses[0].view_idx, 0);
  ASSERT_TRUE(why.behind);
  EXPECT_EQ(why.behind->room_id, 1);
  EXPECT_NEAR(why.behind->gap_m, 0.1, 1e-9);
  ASSERT_EQ(why.openings.size(), 1U);
  EXPECT_NEAR(why.cost.length_m, 3, 1e-9);
  EXPECT_FALSE(Explain(home, home.outer).behind);
  EXPECT_TRUE(Explain(home, home.outer).openings.empty());
}

TEST(ExplainWall, CountsThePointsOnTheFace) {
  SeenPlan home = MakeSeenPlan(0);
  for (const double x : {3.95, 4.02, 4.2}) {
    ScenePoint point;
    point.position = {x, 1.5, 1};
    home.scene.points.push_back(point);
  }
  EXPECT_EQ(Explain(home, home.partition).num_points, 2);
}

TEST(ExplainWall, AWallWithEvidenceIsCheaperThanItsNextBestPlace) {
  const SeenPlan home = MakeSeenPlan(0);
  for (const size_t wall_idx : {home.along_both, home.partition, home.outer}) {
    const WallExplanation why = Explain(home, wall_idx);
    ASSERT_TRUE(why.next_best);
    EXPECT_GT(why.next_best->there.total_m, why.next_best->here.total_m + 0.5) << wall_idx;
  }
}

// A jog that nobody saw: without it the wall is straight, and two corners fewer are to be paid.
TEST(ExplainWall, FindsThePlaceWhereAFalseJogVanishes) {
  SeenPlan home = MakeSeenPlan(0);
  home.evidence = DrawEvidence({Box(0, 0, 4, 4), home.plan.storeys[0].rooms[1].polygon});
  const WallExplanation why = Explain(home, 2);  // from (4, 3) to (2.5, 3)
  ASSERT_TRUE(why.next_best);
  EXPECT_NEAR(why.next_best->outwards_m, 1, 1e-9);
  EXPECT_EQ(why.next_best->there.num_corners, 2);
  EXPECT_LT(why.next_best->there.total_m, why.next_best->here.total_m);
}

TEST(ExplainWall, SaysTheSameOfATurnedHome) {
  const SeenPlan home = MakeSeenPlan(0), turned = MakeSeenPlan(0.6);
  const WallExplanation a = Explain(home, home.partition), b = Explain(turned, home.partition);
  EXPECT_EQ(a.witnesses.size(), b.witnesses.size());
  EXPECT_NEAR(a.sigma.sigma_m, b.sigma.sigma_m, 0.1 * a.sigma.sigma_m);
  EXPECT_EQ(a.behind.has_value(), b.behind.has_value());
}

}  // namespace
}  // namespace enfilade
