// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/positions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::IsEmpty;

// Ten cameras in one room, every pair perfect, and yaws that are not 0.
class MadeTour {
 public:
  explicit MadeTour(double noise_rad = 0) {
    const std::vector<MadeCamera> cameras = SpreadCameras(0.2, 5.8, 2.6, 10, 1);
    scene = MakeRegistrationScene({.wall_x = {0, 6}, .noise_rad = noise_rad}, cameras);
    for (int i = 0; i < scene.num_views(); ++i) {
      level_rays.push_back(LevelRaysOf(scene, i));
      yaws.push_back(cameras[static_cast<size_t>(i)].yaw_rad);
    }
    for (int a = 0; a < scene.num_views(); ++a) {
      for (int b = a + 1; b < scene.num_views(); ++b) pairs.push_back(TruePair(scene, a, b));
    }
  }
  [[nodiscard]] Vector2d TrueAt(int view_idx) const {
    return scene.world_from_cam[static_cast<size_t>(view_idx)].translation.head<2>();
  }
  // Largest distance from the truth once both have `views.front()` at the same place.
  [[nodiscard]] double LargestError(const std::vector<Vector2d>& positions,
                                    const std::vector<int>& views) const {
    double largest = 0;
    for (const int i : views) {
      const Vector2d told =
          positions[static_cast<size_t>(i)] - positions[static_cast<size_t>(views.front())];
      largest = std::max(largest, (told - (TrueAt(i) - TrueAt(views.front()))).norm());
    }
    return largest;
  }
  [[nodiscard]] double LargestError(const std::vector<Vector2d>& positions) const {
    return LargestError(positions, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  }

  RegistrationScene scene;
  std::vector<std::vector<Vector3d>> level_rays;
  std::vector<double> yaws;
  std::vector<PanoPair> pairs;  ///< as they are in truth
};

TEST(CollectLengthRatios, AreThoseOfTheLengths) {
  const MadeTour tour(DegToRad(0.05));
  const std::vector<LengthRatio> ratios = CollectLengthRatios(tour.pairs, tour.level_rays);
  // Every view has 9 pairs, of which any two share features.
  EXPECT_EQ(ratios.size(), 10u * 9u * 8u / 2u);
  for (const LengthRatio& ratio : ratios) {
    const double truth = std::log(tour.pairs[static_cast<size_t>(ratio.pair_idx)].length /
                                  tour.pairs[static_cast<size_t>(ratio.other_idx)].length);
    EXPECT_NEAR(ratio.log_ratio, truth, 0.03);
    EXPECT_GT(ratio.sigma, 0);
  }
}

TEST(CollectLengthRatios, NeedsThreeSharedFeaturesAndAcceptedPairs) {
  MadeTour tour;
  std::vector<PanoPair> pairs = {tour.pairs[0], tour.pairs[1]};  // 0–1 and 0–2
  ASSERT_EQ(CollectLengthRatios(pairs, tour.level_rays).size(), 1u);
  pairs[1].verdict = PairVerdict::kAgainstTriplets;
  EXPECT_THAT(CollectLengthRatios(pairs, tour.level_rays), IsEmpty());
  pairs[1].verdict = PairVerdict::kAccepted;
  pairs[1].inliers.resize(2);
  EXPECT_THAT(CollectLengthRatios(pairs, tour.level_rays), IsEmpty());
  EXPECT_THAT(CollectLengthRatios({}, tour.level_rays), IsEmpty());
}

TEST(SolveLengths, RatiosCarryALengthToAllPairs) {
  const MadeTour tour(DegToRad(0.05));
  std::vector<PanoPair> pairs = tour.pairs;
  for (size_t k = 1; k < pairs.size(); ++k) pairs[k].length = pairs[k].length_sigma = 0;
  SolveLengths(CollectLengthRatios(pairs, tour.level_rays), pairs);
  for (size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_NEAR(pairs[k].length, tour.pairs[k].length, 0.03 * tour.pairs[k].length);
    EXPECT_GT(pairs[k].length_sigma, 0);
  }
}

TEST(SolveLengths, OutvotesWrongLengths) {
  const MadeTour tour(DegToRad(0.05));
  std::vector<PanoPair> pairs = tour.pairs;
  for (size_t k = 0; k < pairs.size(); k += 7) pairs[k].length *= 1.8;
  SolveLengths(CollectLengthRatios(pairs, tour.level_rays), pairs);
  for (size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_NEAR(pairs[k].length, tour.pairs[k].length, 0.05 * tour.pairs[k].length) << k;
  }
}

TEST(SolveLengths, WhatNothingTellsStaysUnknown) {
  const MadeTour tour;
  std::vector<PanoPair> pairs = {tour.pairs[0], tour.pairs[1], tour.pairs[40]};
  pairs[1].length = pairs[2].length = 0;
  const std::vector<LengthRatio> ratios = {{1, 0, 0.5, 0.05}};
  SolveLengths(ratios, pairs);
  EXPECT_NEAR(pairs[0].length, tour.pairs[0].length, 1e-3);
  EXPECT_NEAR(pairs[1].length, std::exp(0.5) * tour.pairs[0].length, 0.01);
  EXPECT_EQ(pairs[2].length, 0);
  std::vector<PanoPair> none;
  SolveLengths({}, none);
  EXPECT_THAT(none, IsEmpty());
}

TEST(SolvePositions, IsExactForPerfectPairs) {
  const MadeTour tour;
  std::vector<PanoPair> pairs = tour.pairs;
  const std::vector<Vector2d> positions = SolvePositions(tour.yaws, pairs);
  ASSERT_EQ(positions.size(), 10u);
  EXPECT_LT(positions[0].norm(), 1e-6);
  EXPECT_LT(tour.LargestError(positions), 1e-6);
  for (const PanoPair& pair : pairs) EXPECT_EQ(pair.verdict, PairVerdict::kAccepted);
}

TEST(SolvePositions, PairsOfUnknownLengthTellTheirDirection) {
  const MadeTour tour;
  std::vector<PanoPair> pairs = tour.pairs;
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (k % 3 != 0) pairs[k].length = pairs[k].length_sigma = 0;
  }
  EXPECT_LT(tour.LargestError(SolvePositions(tour.yaws, pairs)), 0.02);
}

// A fifth of the pairs points anywhere, with any length, and has fewer agreeing matches than
// others.
TEST(SolvePositions, LeavesOutWrongPairs) {
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    const MadeTour tour;
    std::vector<PanoPair> pairs = tour.pairs;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off_deg(30, 330), length(0.5, 4);
    std::vector<bool> is_wrong(pairs.size(), false);
    std::fill_n(is_wrong.begin(), pairs.size() / 5, true);
    std::shuffle(is_wrong.begin(), is_wrong.end(), random);
    for (size_t k = 0; k < pairs.size(); ++k) {
      if (!is_wrong[k]) continue;
      pairs[k].direction = RotationZ(DegToRad(off_deg(random))) * pairs[k].direction;
      pairs[k].length = length(random);
    }
    EXPECT_LT(tour.LargestError(SolvePositions(tour.yaws, pairs)), 0.03) << "seed " << seed;
    for (size_t k = 0; k < pairs.size(); ++k) {
      EXPECT_EQ(pairs[k].verdict,
                is_wrong[k] ? PairVerdict::kAgainstPositions : PairVerdict::kAccepted)
          << "seed " << seed << ", pair " << k;
    }
  }
}

TEST(SolvePositions, ComponentsStartAtTheOrigin) {
  const MadeTour tour;
  std::vector<PanoPair> pairs;
  for (const PanoPair& pair : tour.pairs) {
    if (pair.a_idx % 2 == pair.b_idx % 2) pairs.push_back(pair);
  }
  const std::vector<Vector2d> positions = SolvePositions(tour.yaws, pairs);
  EXPECT_LT(positions[0].norm(), 1e-6);
  EXPECT_LT(positions[1].norm(), 1e-6);
  EXPECT_LT(tour.LargestError(positions, {0, 2, 4, 6, 8}), 1e-6);
  EXPECT_LT(tour.LargestError(positions, {1, 3, 5, 7, 9}), 1e-6);
}

TEST(SolvePositions, PairsOfOnePlaceHoldTogether) {
  const MadeTour tour;
  std::vector<PanoPair> pairs = {tour.pairs[0], tour.pairs[1]};
  pairs[0].verdict = PairVerdict::kSamePlace;
  const std::vector<Vector2d> positions = SolvePositions(std::vector{0.0, 1.0, 2.0}, pairs);
  EXPECT_LT((positions[1] - positions[0]).norm(), 1e-3);
  EXPECT_NEAR((positions[2] - positions[0]).norm(), pairs[1].length, 0.01);
}

TEST(SolvePositions, NoViewsAndNoPairs) {
  std::vector<PanoPair> pairs;
  EXPECT_THAT(SolvePositions({}, pairs), IsEmpty());
  for (const Vector2d& position : SolvePositions(std::vector{0.0, 1.0}, pairs)) {
    EXPECT_LT(position.norm(), 1e-9);
  }
}

}  // namespace
}  // namespace enfilade
