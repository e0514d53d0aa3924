// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The solver on a building of 200 rooms, from what perfect stages before it would find.
#include <gtest/gtest.h>

#include "enfilade/evaluate/judged_plan.h"
#include "enfilade/evaluate/regions.h"
#include "enfilade/evaluate/rooms.h"
#include "enfilade/evidence/accumulate.h"
#include "enfilade/evidence/core.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/synthetic/fixtures.h"
#include "enfilade/synthetic/truth.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

TEST(Building, RoomsAreFoundFromPerfectProfiles) {
  HomeOptions options;
  options.preset = HomePreset::kBuilding;
  options.rooms = 200;
  const Home home = MakeHome(options);
  RunContext context(2);
  ProfileNoise profiles;
  profiles.num_columns = 256;
  profiles.num_bins = 120;
  profiles.are_doors_walls = true;  // else rooms joined by an open door are one
  AccumulateOptions grid;
  grid.cell_m = 0.05;
  EvidenceReport evidence =
      AccumulateEvidence(FixtureWallSamples(home, profiles), {}, grid, context);
  ASSERT_EQ(evidence.outcome, EvidenceOutcome::kDone);
  CoreReport core = FindCore(evidence.grids, {}, context);
  evidence.grids.core = std::move(core.core);
  evidence.grids.num_cores = core.num_cores;
  const FloorplanReport report = SolveFloorplan(
      FixtureScene(home), FixtureStructure(home, profiles), {evidence.grids}, {}, context);
  ExpectValidFloorplan(report.plan);
  const JudgedPlan result = JudgedPlanOf(report.plan), truth = JudgedPlanOf(TruthFloorplan(home));
  const RoomFigures rooms = EvaluateRooms(result, truth);
  const RegionFigures regions = EvaluateRegions(result, truth);
  EXPECT_EQ(rooms.total, 200);
  EXPECT_GE(rooms.iou90, 198);  // all 200 when this was written
  EXPECT_EQ(rooms.split, 0);
  EXPECT_EQ(rooms.merged, 0);
  EXPECT_EQ(rooms.false_rooms, 0);
  EXPECT_GE(regions.iou_net, 0.98);
  EXPECT_GE(regions.iou_gross, 0.99);
}

}  // namespace
}  // namespace enfilade
