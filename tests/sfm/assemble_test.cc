// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/assemble.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "enfilade/geometry/rigid3.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

struct Place {
  double x, y, yaw_rad;
};

// The pair as it is, or as it would be if b stood elsewhere.
PanoPair PairOf(int a_idx, int b_idx, const Place& a, const Place& b, double log10_chance) {
  PanoPair pair;
  pair.a_idx = a_idx;
  pair.b_idx = b_idx;
  pair.verdict = PairVerdict::kAccepted;
  pair.log10_chance = log10_chance;
  pair.inliers.resize(30);
  pair.a_from_b = RotationZ(b.yaw_rad - a.yaw_rad);
  const Vector3d step(b.x - a.x, b.y - a.y, 0);
  pair.direction = RotationZ(-a.yaw_rad) * step.normalized();
  pair.length = step.norm();
  pair.length_sigma = 0.03;
  return pair;
}

// Two rooms of two cameras each.
constexpr std::array<Place, 4> kPlaces = {
    {{0, 0, 0.3}, {1.2, 0.2, -1}, {4, 0.5, 2}, {4.2, 1.9, 0.5}}};

std::vector<PanoPair> TwoRooms() {
  return {PairOf(0, 1, kPlaces[0], kPlaces[1], -90), PairOf(2, 3, kPlaces[2], kPlaces[3], -120)};
}

TEST(AssembleGroups, JoinsByWeakPairsThatTellTheSame) {
  std::vector<PanoPair> pairs = TwoRooms();
  pairs.push_back(PairOf(1, 2, kPlaces[1], kPlaces[2], -13));
  std::vector<PanoPair> one = pairs;
  AssembleGroups(4, one);
  EXPECT_EQ(one[2].verdict, PairVerdict::kChance);
  pairs.push_back(PairOf(0, 3, kPlaces[0], kPlaces[3], -12));
  pairs.back().length = 0;  // direction alone
  AssembleGroups(4, pairs);
  for (const PanoPair& pair : pairs) EXPECT_EQ(pair.verdict, PairVerdict::kAccepted);
}

TEST(AssembleGroups, RefusesWhatContradictsGroups) {
  std::vector<PanoPair> pairs = TwoRooms();
  pairs.push_back(PairOf(1, 2, kPlaces[1], kPlaces[2], -28));
  pairs.push_back(PairOf(0, 2, kPlaces[0], {-3, 1, 2}, -14));
  AssembleGroups(4, pairs);
  EXPECT_EQ(pairs[2].verdict, PairVerdict::kAccepted);
  EXPECT_EQ(pairs[3].verdict, PairVerdict::kAgainstPositions);
}

TEST(AssembleGroups, DecidesNotBetweenRivals) {
  std::vector<PanoPair> pairs = TwoRooms();
  pairs.push_back(PairOf(1, 2, kPlaces[1], kPlaces[2], -26));
  pairs.push_back(PairOf(0, 3, kPlaces[0], {-3, 1, 2}, -22));
  AssembleGroups(4, pairs);
  EXPECT_EQ(pairs[2].verdict, PairVerdict::kChance);
  EXPECT_EQ(pairs[3].verdict, PairVerdict::kChance);
}

}  // namespace
}  // namespace enfilade
