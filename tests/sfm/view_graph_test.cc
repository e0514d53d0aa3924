// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/view_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

PanoPair MakePair(int a_idx, int b_idx, double yaw_rad,
                  PairVerdict verdict = PairVerdict::kAccepted, size_t num_inliers = 50) {
  PanoPair pair;
  pair.a_idx = a_idx;
  pair.b_idx = b_idx;
  pair.verdict = verdict;
  pair.inliers.resize(num_inliers);
  pair.a_from_b = RotationZ(yaw_rad);
  return pair;
}

// The pairs that a share of all possible pairs would be, with the yaws that `truth` gives.
std::vector<PanoPair> PairsOf(std::span<const double> truth, double share, double noise_rad,
                              std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  std::vector<PanoPair> pairs;
  for (size_t a = 0; a < truth.size(); ++a) {
    for (size_t b = a + 1; b < truth.size(); ++b) {
      if (uniform(random) > share) continue;
      pairs.push_back(MakePair(static_cast<int>(a), static_cast<int>(b),
                               truth[b] - truth[a] + noise_rad * normal(random)));
    }
  }
  return pairs;
}

std::vector<double> RandomYaws(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-kPi, kPi);
  std::vector<double> yaws;
  for (int i = 0; i < count; ++i) yaws.push_back(uniform(random));
  return yaws;
}

// Largest error once view 0 has its true yaw.
double LargestError(std::span<const double> yaws, std::span<const double> truth) {
  double largest = 0;
  for (size_t i = 0; i < yaws.size(); ++i) {
    const double error = WrapPi((yaws[i] - yaws[0]) - (truth[i] - truth[0]));
    largest = std::max(largest, std::abs(error));
  }
  return largest;
}

TEST(IsConnecting, AcceptedPairsAndThoseOfOnePlace) {
  for (const PairVerdict verdict :
       {PairVerdict::kAccepted, PairVerdict::kSamePlace, PairVerdict::kFewMatches,
        PairVerdict::kChance, PairVerdict::kAgainstTriplets, PairVerdict::kAgainstPositions}) {
    EXPECT_EQ(IsConnecting(MakePair(0, 1, 0, verdict)),
              verdict == PairVerdict::kAccepted || verdict == PairVerdict::kSamePlace);
  }
}

TEST(AverageYaws, IsExactForPerfectPairs) {
  std::mt19937 random(1);
  for (const double share : {1.0, 0.5}) {
    const std::vector<double> truth = RandomYaws(12, random);
    std::vector<PanoPair> pairs = PairsOf(truth, share, 0, random);
    const std::vector<double> yaws = AverageYaws(12, pairs);
    ASSERT_EQ(yaws.size(), 12u);
    EXPECT_NEAR(yaws[0], 0, 1e-9);
    EXPECT_LT(LargestError(yaws, truth), 1e-9);
    for (const PanoPair& pair : pairs) EXPECT_EQ(pair.verdict, PairVerdict::kAccepted);
  }
}

// A yaw is the mean of 11 pairs that err by 0.5°, and so is the first view's: 0.2° is one sigma.
TEST(AverageYaws, AveragesNoise) {
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const std::vector<double> truth = RandomYaws(12, random);
    std::vector<PanoPair> pairs = PairsOf(truth, 1, DegToRad(0.5), random);
    EXPECT_LT(RadToDeg(LargestError(AverageYaws(12, pairs), truth)), 0.8);
  }
}

TEST(AverageYaws, FindsWrongPairsInADenseGraph) {
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const std::vector<double> truth = RandomYaws(12, random);
    std::vector<PanoPair> pairs = PairsOf(truth, 1, DegToRad(0.2), random);
    std::vector<bool> is_wrong(pairs.size(), false);
    std::fill_n(is_wrong.begin(), pairs.size() * 3 / 10, true);
    std::shuffle(is_wrong.begin(), is_wrong.end(), random);
    std::uniform_real_distribution<double> off(DegToRad(15), DegToRad(345));
    for (size_t k = 0; k < pairs.size(); ++k) {
      if (is_wrong[k]) pairs[k].a_from_b = RotationZ(pairs[k].Yaw_rad() + off(random));
    }
    const std::vector<double> yaws = AverageYaws(12, pairs);
    EXPECT_LT(RadToDeg(LargestError(yaws, truth)), 0.6) << "seed " << seed;
    for (size_t k = 0; k < pairs.size(); ++k) {
      EXPECT_EQ(pairs[k].verdict,
                is_wrong[k] ? PairVerdict::kAgainstTriplets : PairVerdict::kAccepted)
          << "seed " << seed << ", pair " << k;
    }
  }
}

TEST(AverageYaws, EachComponentHasItsOwnOrigin) {
  std::vector<PanoPair> pairs = {MakePair(0, 3, 0.5), MakePair(1, 2, -1.0, PairVerdict::kSamePlace),
                                 MakePair(3, 4, 3.0), MakePair(0, 1, 2.0, PairVerdict::kChance)};
  const std::vector<double> yaws = AverageYaws(6, pairs);
  const std::vector<double> truth = {0, 0, -1.0, 0.5, 3.5 - 2 * kPi, 0};
  for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(yaws[i], truth[i], 1e-9) << "view " << i;
  EXPECT_EQ(pairs.back().verdict, PairVerdict::kChance);
}

TEST(AverageYaws, APairThatContradictsMayCutTheGraph) {
  // Two triangles, joined by two bridges that differ by 40°: the weaker one goes.
  std::mt19937 random(3);
  const std::vector<double> truth = RandomYaws(6, random);
  const auto yaw = [&](int a, int b) {
    return truth[static_cast<size_t>(b)] - truth[static_cast<size_t>(a)];
  };
  std::vector<PanoPair> pairs;
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}, {3, 4}, {3, 5}, {4, 5}}) {
    pairs.push_back(MakePair(a, b, yaw(a, b)));
  }
  pairs.push_back(
      MakePair(2, 3, yaw(2, 3) + DegToRad(40), PairVerdict::kAccepted, /*num_inliers=*/9));
  pairs.push_back(MakePair(0, 5, yaw(0, 5), PairVerdict::kAccepted, /*num_inliers=*/200));
  EXPECT_LT(RadToDeg(LargestError(AverageYaws(6, pairs), truth)), 0.1);
  EXPECT_EQ(pairs[6].verdict, PairVerdict::kAgainstTriplets);
  EXPECT_EQ(pairs[7].verdict, PairVerdict::kAccepted);
}

TEST(AverageYaws, NoViewsAndNoPairs) {
  std::vector<PanoPair> pairs;
  EXPECT_THAT(AverageYaws(0, pairs), IsEmpty());
  EXPECT_THAT(AverageYaws(3, pairs), ElementsAre(0, 0, 0));
}

// Twin: floods from every view that has no label yet, then sorts by size and lowest view.
std::vector<int> FloodComponents(int num_views, std::span<const PanoPair> pairs) {
  std::vector<std::set<int>> components;
  std::vector<bool> is_done(static_cast<size_t>(num_views), false);
  for (int start = 0; start < num_views; ++start) {
    if (is_done[static_cast<size_t>(start)]) continue;
    std::set<int> reached = {start};
    for (size_t before = 0; before != reached.size();) {
      before = reached.size();
      for (const PanoPair& pair : pairs) {
        if (!IsConnecting(pair)) continue;
        if (reached.contains(pair.a_idx)) reached.insert(pair.b_idx);
        if (reached.contains(pair.b_idx)) reached.insert(pair.a_idx);
      }
    }
    for (const int view : reached) is_done[static_cast<size_t>(view)] = true;
    components.push_back(reached);
  }
  std::stable_sort(components.begin(), components.end(),
                   [](const auto& x, const auto& y) { return x.size() > y.size(); });
  std::vector<int> component_idx(static_cast<size_t>(num_views));
  for (size_t k = 0; k < components.size(); ++k) {
    for (const int view : components[k]) {
      component_idx[static_cast<size_t>(view)] = static_cast<int>(k);
    }
  }
  return component_idx;
}

TEST(FindComponents, AgreesWithFlooding) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const int num_views = 1 + static_cast<int>(random() % 14);
    std::vector<PanoPair> pairs;
    for (uint32_t k = 0; k < random() % 15; ++k) {
      const int a = static_cast<int>(random() % static_cast<uint32_t>(num_views));
      const int b = static_cast<int>(random() % static_cast<uint32_t>(num_views));
      if (a != b) {
        pairs.push_back(
            MakePair(std::min(a, b), std::max(a, b), 0, static_cast<PairVerdict>(random() % 6)));
      }
    }
    EXPECT_EQ(FindComponents(num_views, pairs), FloodComponents(num_views, pairs));
  }
}

TEST(FindComponents, NumbersFromTheLargest) {
  const std::vector<PanoPair> pairs = {MakePair(1, 3, 0), MakePair(2, 4, 0), MakePair(4, 5, 0)};
  EXPECT_THAT(FindComponents(7, pairs), ElementsAre(2, 1, 0, 1, 0, 0, 3));
  EXPECT_THAT(FindComponents(0, {}), IsEmpty());
}

}  // namespace
}  // namespace enfilade
