// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/wall_witness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/floorplan/seen_plan.h"

namespace enfilade {
namespace {

std::vector<std::vector<WallWitness>> Find(const SeenPlan& home) {
  return FindWallWitnesses(home.scene, home.structure, home.plan.storeys[0], 0);
}

TEST(FindWallWitnesses, EveryColumnOfPerfectProfilesAgreesWithItsWall) {
  for (const double angle_rad : {0.0, 0.3, 2.0}) {
    size_t num_sightings = 0;
    for (const auto& of_wall : Find(MakeSeenPlan(angle_rad))) {
      for (const WallWitness& witness : of_wall) {
        num_sightings += witness.sightings.size();
        EXPECT_EQ(witness.agreeing_share, 1);
        EXPECT_NEAR(witness.offset_m, 0, 1e-5);
      }
    }
    EXPECT_EQ(num_sightings, 512U);
  }
}

TEST(FindWallWitnesses, MeasuresDistanceRangeAndIncidence) {
  const SeenPlan home = MakeSeenPlan(0.3);
  const auto witnesses = Find(home);
  ASSERT_EQ(witnesses[home.partition].size(), 1U);
  const WallWitness& witness = witnesses[home.partition][0];
  EXPECT_EQ(witness.view_idx, 0);
  EXPECT_NEAR(witness.distance_m, 2, 1e-9);
  for (const WallSighting& sighting : witness.sightings) {
    EXPECT_NEAR(sighting.distance_m * std::cos(sighting.incidence_rad), 2, 1e-9);
    EXPECT_GE(sighting.along_m, 0);
    EXPECT_LE(sighting.along_m, 3);
  }
  // Half of the columns that see the wall, which spans ± atan(1.5 / 2), are farther off its normal.
  EXPECT_NEAR(witness.incidence_rad, 0.5 * std::atan2(1.5, 2), 0.03);
}

TEST(FindWallWitnesses, LookThroughPassagesAtTheWallBehindAndDisagree) {
  const SeenPlan closed = MakeSeenPlan(0.3), open = MakeSeenPlan(0.3, true);
  EXPECT_EQ(Find(closed)[open.far_wall].size(), 1U);
  const auto witnesses = Find(open);
  ASSERT_EQ(witnesses[open.far_wall].size(), 2U);
  const WallWitness& from_first_room = witnesses[open.far_wall][0];
  EXPECT_EQ(from_first_room.view_idx, 0);
  EXPECT_NEAR(from_first_room.distance_m, 5, 1e-9);
  EXPECT_EQ(from_first_room.agreeing_share, 0);  // its profile ends at the partition
  EXPECT_NEAR(from_first_room.offset_m, -3, 1e-4);
}

TEST(FindWallWitnesses, LeaveOutColumnsThatThePictureDoesNotCover) {
  SeenPlan home = MakeSeenPlan(0);
  home.structure.profiles[0].is_seen.assign(256, 0);
  EXPECT_TRUE(Find(home)[home.partition].empty());
}

TEST(FindWallWitnesses, OtherStoreysSeeNothing) {
  const SeenPlan home = MakeSeenPlan(0);
  for (const auto& of_wall : FindWallWitnesses(home.scene, home.structure, home.plan.storeys[0], 1))
    EXPECT_TRUE(of_wall.empty());
}

}  // namespace
}  // namespace enfilade
