// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// How much of the plan is left when what the stages before found is noisy.
#include <gtest/gtest.h>

#include "enfilade/evidence/accumulate.h"
#include "enfilade/evidence/core.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/geometry/boolean.h"
#include "enfilade/synthetic/fixture_points.h"
#include "enfilade/synthetic/fixture_poses.h"
#include "enfilade/synthetic/fixtures.h"
#include "enfilade/synthetic/text_home.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

Home TwoRooms() {
  return TextHome(
      "room 0,0 4.5,0 4.5,2.5 3,2.5 3,4 0,4 | room 4.62,0 8,0 8,3.6 4.62,3.6 | door 4.5,1 4.5,1.9 "
      "| "
      "camera 1.2,1.5 | camera 3.3,1.2 | camera 1.6,3.1 | camera 6,1.4 | camera 7,2.6");
}

MultiPolygon2 Region(const Home& home) {
  MultiPolygon2 region;
  for (const HomeRoom& room : home.rooms) region.push_back(room.polygon);
  return region;
}

// Profiles with a little noise of their own.
ProfileNoise UsualProfiles() {
  ProfileNoise noise;
  noise.sigma_relative = 0.01;
  noise.outlier_share = 0.03;
  return noise;
}

// IoU of the plan's region with the home's.
double PlanIou(const Home& home, const WallSampleSet& samples, const EvidencePoints& points = {}) {
  RunContext context(2);
  AccumulateOptions grid;
  grid.cell_m = 0.05;  // fast
  EvidenceReport evidence = AccumulateEvidence(samples, points, grid, context);
  CoreReport core = FindCore(evidence.grids, {}, context);
  evidence.grids.core = std::move(core.core);
  evidence.grids.num_cores = core.num_cores;
  const FloorplanReport report =
      SolveFloorplan(FixtureScene(home), FixtureStructure(home), {evidence.grids}, {}, context);
  ExpectValidFloorplan(report.plan);
  MultiPolygon2 region;
  for (const Room& room : report.plan.storeys.at(0).rooms) region.push_back(room.polygon);
  return AreaIou(Union(region), Region(home));
}

// Mean over a few draws of the noise.
double MeanIou(PoseNoise noise) {
  constexpr int kDraws = 2;
  const Home home = TwoRooms();
  double sum = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    noise.seed = static_cast<uint64_t>(draw);
    sum += PlanIou(home, FixtureWallSamples(home, UsualProfiles(), FixturePoses(home, noise)));
  }
  return sum / kDraws;
}

TEST(NoisyPoses, ThePlanFadesGracefully) {
  const Home home = TwoRooms();
  const double exact = PlanIou(home, FixtureWallSamples(home, UsualProfiles()));
  EXPECT_GT(exact, 0.98);
  PoseNoise noise;
  noise.position_sigma_m = 0.03;
  noise.yaw_sigma_deg = 0.5;
  EXPECT_GT(MeanIou(noise), exact - 0.02);
  noise.position_sigma_m = 0.08;
  noise.yaw_sigma_deg = 1;
  EXPECT_GT(MeanIou(noise), exact - 0.06);
}

TEST(NoisyPoses, DriftAlongTheCaptureOnlyBendsThePlan) {
  PoseNoise noise;
  noise.drift_m = 0.02;
  noise.yaw_drift_deg = 0.3;
  EXPECT_GT(MeanIou(noise), 0.95);
}

TEST(NoisyPoints, PatchesOfMultiViewStereoDoNoHarm) {
  const Home home = TwoRooms();
  const WallSampleSet samples = FixtureWallSamples(home, UsualProfiles());
  EvidencePoints points;
  points.points = FixturePoints(home);  // world and home frame are one
  ASSERT_GT(points.points.size(), 2000u);
  for (const HomeCamera& camera : home.cameras)
    points.camera_positions.push_back(camera.home_from_cam.translation);
  points.floor_z = home.rooms[0].floor_z;
  points.ceiling_z = home.rooms[0].ceiling_z;
  EXPECT_GT(PlanIou(home, samples, points), PlanIou(home, samples) - 0.01);
}

}  // namespace
}  // namespace enfilade
