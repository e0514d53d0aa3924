// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/plane_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

std::vector<PointPair> NoisyPairs(std::mt19937& random, int count, int num_outliers, double noise_m,
                                  const Similarity2& motion) {
  std::uniform_real_distribution<double> place(-5, 5);
  std::normal_distribution<double> noise(0, noise_m);
  std::vector<PointPair> pairs;
  for (int i = 0; i < count; ++i) {
    const Vector2d p(place(random), place(random));
    Vector2d q = motion * p + Vector2d(noise(random), noise(random));
    if (i < num_outliers) q += Vector2d(place(random), place(random));
    pairs.push_back({p, q});
  }
  return pairs;
}

// The twin: least squares on every subset of the pairs. The best fit is that of its own inliers.
double SlowLeastCost(const std::vector<PointPair>& pairs, bool has_scale) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned subset = 0; subset < (1u << pairs.size()); ++subset) {
    std::vector<PointPair> chosen;
    for (size_t i = 0; i < pairs.size(); ++i) {
      if ((subset >> i & 1u) != 0) chosen.push_back(pairs[i]);
    }
    if (chosen.size() < 2) continue;
    least = std::min(least, FitCost(FitLeastSquares(chosen, has_scale), pairs));
  }
  return least;
}

TEST(FitRobust, AgreesWithItsBruteForceTwin) {
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    const bool has_scale = round % 2 == 1;
    const Similarity2 motion{has_scale ? 1.1 : 1.0, 0.3 * round, {2, -1}};
    const auto pairs = NoisyPairs(random, 8, round % 4, 0.15, motion);
    const auto fit = FitRobust(pairs, has_scale);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(FitCost(*fit, pairs), SlowLeastCost(pairs, has_scale), 1e-9) << round;
  }
}

// The twin of least squares: nothing near it is better.
TEST(FitLeastSquares, IsALeastCost) {
  std::mt19937 random(4);
  for (const bool has_scale : {false, true}) {
    const auto pairs = NoisyPairs(random, 6, 0, 0.05, {has_scale ? 0.8 : 1.0, 2.5, {1, 2}});
    const Similarity2 fit = FitLeastSquares(pairs, has_scale);
    for (const double step : {-1e-3, 1e-3}) {
      for (int k = 0; k < (has_scale ? 4 : 3); ++k) {
        Similarity2 other = fit;
        if (k == 0) other.angle_rad += step;
        if (k == 1) other.translation.x() += step;
        if (k == 2) other.translation.y() += step;
        if (k == 3) other.scale += step;
        EXPECT_GT(FitCost(other, pairs), FitCost(fit, pairs)) << k;
      }
    }
  }
}

TEST(FitRobust, OutliersDoNotMoveIt) {
  std::mt19937 random(5);
  const Similarity2 motion{1, 2.9, {3, 4}};
  const auto fit = FitRobust(NoisyPairs(random, 40, 15, 0, motion), false);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(WrapPi(fit->angle_rad - motion.angle_rad), 0, 1e-9);
  EXPECT_NEAR((fit->translation - motion.translation).norm(), 0, 1e-9);
  EXPECT_EQ(fit->scale, 1);
}

TEST(FitRobust, ManyPairsAreThinned) {
  std::mt19937 random(6);
  const Similarity2 motion{1.05, -1, {0, 1}};
  const auto fit = FitRobust(NoisyPairs(random, 400, 100, 0.02, motion), true);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 1.05, 1e-3);
}

TEST(FitRobust, PointsInOnePlaceGiveNone) {
  EXPECT_FALSE(FitRobust({}, false));
  const std::vector<PointPair> pairs(3, PointPair{{1, 1}, {2, 2}});
  EXPECT_FALSE(FitRobust(pairs, false));
}

}  // namespace
}  // namespace enfilade
