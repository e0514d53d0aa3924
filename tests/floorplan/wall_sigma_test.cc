// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/wall_sigma.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/floorplan/seen_plan.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

TEST(SigmaOfMixture, IsTheMeasuredOneWhenNothingElseCanBe) {
  EXPECT_NEAR(SigmaOfMixture(0.03, 0), 0.03, 1e-9);
}

TEST(SigmaOfMixture, GrowsWithBothTerms) {
  double last = 0;
  for (const double wrong : {0.0, 0.05, 0.2, 0.5, 1.0}) {
    const double sigma = SigmaOfMixture(0.03, wrong);
    EXPECT_GT(sigma, last) << wrong;
    EXPECT_LT(SigmaOfMixture(0.03, wrong), SigmaOfMixture(0.06, wrong) + 1e-9) << wrong;
    last = sigma;
  }
}

TEST(SigmaOfMixture, HoldsTheSharesOfANormalDistributionInDraws) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 0.03);
  std::exponential_distribution<double> other(1 / 0.71);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double wrong : {0.02, 0.1, 0.3, 0.7}) {
    const double sigma = SigmaOfMixture(0.03, wrong);
    int within1 = 0, within2 = 0;
    constexpr int kDraws = 40000;
    for (int i = 0; i < kDraws; ++i) {
      const double error = uniform(random) < wrong ? other(random) : std::abs(normal(random));
      within1 += error < sigma;
      within2 += error < 2 * sigma;
    }
    EXPECT_NEAR((2.0 * within1 + within2) / kDraws, 2 * 0.6827 + 0.9545, 0.02) << wrong;
  }
}

// Sums by brute force: errors drawn as the model says, areas and lengths of the moved polygon.
TEST(AssignSigmas, CarriesOffsetsIntoLengthsAndAreas) {
  SeenPlan home = MakeSeenPlan(std::numbers::pi / 7);
  AssignSigmas(home.scene, home.structure, {home.evidence}, {}, home.plan);
  const Storey& storey = home.plan.storeys[0];
  const auto sigmas = FindWallSigmas(home.evidence, storey,
                                     FindWallWitnesses(home.scene, home.structure, storey, 0), {});
  const std::vector<Wall>& walls = storey.walls;
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  for (const Wall& wall : walls) EXPECT_GT(wall.sigma_m, 0);
  const size_t n = home.num_walls_of_first_room;
  double area_square = 0;
  std::vector<double> length_square(n, 0);
  constexpr int kDraws = 20000;
  constexpr double kSmall = 1e-3;  // errors so small that areas change in proportion
  for (int draw = 0; draw < kDraws; ++draw) {
    const double common = normal(random);
    std::vector<double> out(n);
    for (size_t i = 0; i < n; ++i) {
      const double shared = std::sqrt(kSharedVariance) * sigmas[i].measured_m;
      const double own = std::sqrt(sigmas[i].sigma_m * sigmas[i].sigma_m - shared * shared);
      out[i] = kSmall * (shared * common + own * normal(random));
    }
    Ring2 moved;
    for (size_t i = 0; i < n; ++i) {  // where wall i − 1 and wall i meet
      const Wall& before = walls[(i + n - 1) % n];
      Eigen::Matrix2d normals;
      const auto outward = [](const Wall& wall) {
        const Vector2d along = (wall.b - wall.a).normalized();
        return Vector2d(along.y(), -along.x());
      };
      normals << outward(before).transpose(), outward(walls[i]).transpose();
      const Vector2d offsets(outward(before).dot(before.a) + out[(i + n - 1) % n],
                             outward(walls[i]).dot(walls[i].a) + out[i]);
      moved.push_back(normals.inverse() * offsets);
    }
    const double area_error = (SignedArea(moved) - Area(storey.rooms[0].polygon)) / kSmall;
    area_square += area_error * area_error;
    for (size_t i = 0; i < n; ++i) {
      const double error =
          ((moved[(i + 1) % n] - moved[i]).norm() - (walls[i].b - walls[i].a).norm()) / kSmall;
      length_square[i] += error * error;
    }
  }
  const double area_sigma = std::sqrt(area_square / kDraws);
  EXPECT_NEAR(storey.rooms[0].area_sigma_m2, area_sigma, 0.03 * area_sigma);
  for (size_t i = 0; i < n; ++i) {
    const double sigma = std::sqrt(length_square[i] / kDraws);
    EXPECT_NEAR(walls[i].length_sigma_m, sigma, 0.03 * sigma) << i;
  }
}

TEST(FindWallSigmas, KnowsTwinsCollinearWallsAndWhoAgrees) {
  const SeenPlan home = MakeSeenPlan(0);
  const Storey& storey = home.plan.storeys[0];
  const auto sigmas = FindWallSigmas(home.evidence, storey,
                                     FindWallWitnesses(home.scene, home.structure, storey, 0), {});
  const WallSigma& partition = sigmas[home.partition];
  EXPECT_TRUE(partition.grounds.has_twin);
  EXPECT_EQ(partition.grounds.num_agreeing, 1);
  EXPECT_NEAR(partition.distance_m, home.camera_to_partition_m, 1e-9);
  const WallSigma& outer = sigmas[home.outer];
  EXPECT_FALSE(outer.grounds.has_twin);
  EXPECT_GT(outer.wrong_probability, partition.wrong_probability);
  EXPECT_NEAR(sigmas[home.along_both].grounds.collinear_m, home.second_room_width_m, 1e-9);
}

}  // namespace
}  // namespace enfilade
