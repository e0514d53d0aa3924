// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/point_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace enfilade {
namespace {

using Eigen::Vector2d;

// The twin: the best over all orders in which the points of `a` choose.
int SlowCount(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b, double max_distance) {
  std::vector<size_t> order(b.size());
  std::iota(order.begin(), order.end(), 0U);
  int best = 0;
  do {
    int hits = 0;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      hits += (a[i] - b[order[i]]).norm() <= max_distance;
    }
    best = std::max(best, hits);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(CountPointMatches, AgreesWithItsBruteForceTwin) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vector2d> a, b;
    for (int i = 0; i < 5; ++i) a.emplace_back(place(random), place(random));
    for (int i = 0; i < 6; ++i) b.emplace_back(place(random), place(random));
    EXPECT_EQ(CountPointMatches(a, b, 0.3), SlowCount(a, b, 0.3));
  }
}

TEST(CountPointMatches, TakesTheDetourThatAGreedyChoiceMisses) {
  // The first point could take either; only the second of b is left for it.
  EXPECT_EQ(CountPointMatches({{0, 0}, {-0.9, 0}}, {{0, 0}, {0.9, 0}}, 1.0), 2);
  EXPECT_EQ(CountPointMatches({}, {{0, 0}}, 1.0), 0);
}

TEST(F1, OfNothingIsNone) {
  EXPECT_EQ(F1(0, 0, 0), std::nullopt);
  EXPECT_EQ(F1(1, 1, 3), 0.5);
}

}  // namespace
}  // namespace enfilade
