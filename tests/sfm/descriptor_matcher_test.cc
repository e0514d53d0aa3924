// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/descriptor_matcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "enfilade/base/errors.h"
#include "tests/sfm/random_descriptors.h"

namespace enfilade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// RootSIFT of random histograms: unit length before it is quantised.
DescriptorSet RandomRootSift(int size, uint32_t seed) {
  DescriptorSet set;
  std::mt19937 random(seed);
  std::vector<double> histogram(kDescriptorSize);
  for (int i = 0; i < size; ++i) {
    for (double& h : histogram) h = std::pow(static_cast<double>(random() % 1000) / 1000, 3);
    const double sum = std::accumulate(histogram.begin(), histogram.end(), 0.0);
    for (const double h : histogram) {
      const double value =
          std::min<double>(kMaxDescriptorValue, kDescriptorScale * std::sqrt(h / sum));
      set.values.push_back(static_cast<uint8_t>(value));
    }
  }
  return set;
}

// One descriptor a row, given by its first values; the others are 0.
DescriptorSet Rows(const std::vector<std::vector<int>>& rows) {
  DescriptorSet set;
  for (const std::vector<int>& row : rows) {
    set.values.resize(set.values.size() + kDescriptorSize);
    uint8_t* const to = set.values.data() + set.values.size() - kDescriptorSize;
    for (size_t i = 0; i < row.size(); ++i) to[i] = static_cast<uint8_t>(row[i]);
  }
  return set;
}

DescriptorMatchOptions Any() { return {.max_ratio = 1, .max_distance = 2, .is_mutual = false}; }

// Rows of `a` stand in `b` in another order, each value off by −4 … 4, among as many strangers.
// A pair is 29 apart on average (√(128 · 20/3)); strangers are 100 or more.
TEST(MatchDescriptors, FindsPlantedMatches) {
  constexpr int kNum = 1500;
  const DescriptorSet a = RandomRootSift(kNum, 1);
  DescriptorSet b = RandomRootSift(2 * kNum, 2);
  std::mt19937 random(3);
  for (int i = 0; i < kNum; ++i) {
    uint8_t* const to = b.values.data() + static_cast<size_t>(i * 7 % (2 * kNum)) * kDescriptorSize;
    for (int k = 0; k < kDescriptorSize; ++k)
      to[k] = static_cast<uint8_t>(
          std::clamp(a.row(i)[k] + static_cast<int>(random() % 9) - 4, 0, 127));
  }
  const std::vector<FeatureMatch> matches = MatchDescriptors(a, b, {});
  ASSERT_EQ(matches.size(), static_cast<size_t>(kNum));
  for (int i = 0; i < kNum; ++i) {
    EXPECT_EQ(matches[static_cast<size_t>(i)].a_idx, i);
    EXPECT_EQ(matches[static_cast<size_t>(i)].b_idx, i * 7 % (2 * kNum));
    EXPECT_LT(matches[static_cast<size_t>(i)].ratio, 0.5f);
  }
}

TEST(MatchDescriptors, StrangersDoNotMatch) {
  EXPECT_THAT(MatchDescriptors(RandomRootSift(500, 1), RandomRootSift(500, 2), {}), IsEmpty());
}

TEST(MatchDescriptors, RatioIsThatOfTheDistances) {
  const DescriptorSet a = Rows({{10, 0}}), b = Rows({{10, 40}, {10, 30}, {0, 50}});
  EXPECT_THAT(MatchDescriptors(a, b, Any()), ElementsAre(FeatureMatch{0, 1, 0.75f}));
  DescriptorMatchOptions options = Any();
  options.max_ratio = 0.75;
  EXPECT_EQ(MatchDescriptors(a, b, options).size(), 1u);
  options.max_ratio = 0.7499;
  EXPECT_THAT(MatchDescriptors(a, b, options), IsEmpty());
}

TEST(MatchDescriptors, NormsOfTheRowsCount) {
  // The longest has the largest product with {20}, and is not the nearest.
  const DescriptorSet a = Rows({{20}}), b = Rows({{100}, {22}, {10}});
  EXPECT_THAT(MatchDescriptors(a, b, Any()), ElementsAre(FeatureMatch{0, 1, 0.2f}));
}

TEST(MatchDescriptors, OnlyOneCandidateHasNoRatio) {
  const DescriptorSet a = Rows({{20}, {90}}), b = Rows({{21}});
  EXPECT_THAT(MatchDescriptors(a, b, {}), ElementsAre(FeatureMatch{0, 0, 0}));
}

TEST(MatchDescriptors, TwinsAreAmbiguous) {
  const DescriptorSet a = Rows({{20}}), b = Rows({{90}, {20}, {20}});
  EXPECT_THAT(MatchDescriptors(a, b, {}), IsEmpty());
  EXPECT_THAT(MatchDescriptors(a, b, Any()), ElementsAre(FeatureMatch{0, 1, 1}));
}

TEST(MatchDescriptors, BoundsTheDistance) {
  const DescriptorSet a = Rows({{0}}), b = Rows({{32}});  // 32 of 256 is 0.125
  DescriptorMatchOptions options = Any();
  options.max_distance = 0.125;
  EXPECT_EQ(MatchDescriptors(a, b, options).size(), 1u);
  options.max_distance = 0.1249;
  EXPECT_THAT(MatchDescriptors(a, b, options), IsEmpty());
}

TEST(MatchDescriptors, MutualMatchesAreTheSameBothWays) {
  const DescriptorSet a = RandomRootSift(300, 1), b = RandomRootSift(400, 2);
  DescriptorMatchOptions options = Any();
  EXPECT_EQ(MatchDescriptors(a, b, options).size(), 300u);
  options.is_mutual = true;
  std::vector<std::pair<int, int>> there, back;
  for (const FeatureMatch& m : MatchDescriptors(a, b, options))
    there.emplace_back(m.a_idx, m.b_idx);
  for (const FeatureMatch& m : MatchDescriptors(b, a, options)) back.emplace_back(m.b_idx, m.a_idx);
  std::sort(back.begin(), back.end());
  EXPECT_GT(there.size(), 50u);
  EXPECT_LT(there.size(), 300u);
  EXPECT_EQ(there, back);
}

TEST(MatchDescriptors, MutualTiesGoToTheLowestIndex) {
  const DescriptorSet a = Rows({{5}, {5}, {5}}), b = Rows({{5}, {5}});
  DescriptorMatchOptions options = Any();
  options.is_mutual = true;
  EXPECT_THAT(MatchDescriptors(a, b, options), ElementsAre(FeatureMatch{0, 0, 1}));
}

TEST(MatchDescriptors, EmptySetsMatchNothing) {
  const DescriptorSet some = RandomRootSift(3, 1), none;
  EXPECT_THAT(MatchDescriptors(some, none, {}), IsEmpty());
  EXPECT_THAT(MatchDescriptors(none, some, {}), IsEmpty());
  EXPECT_THAT(MatchDescriptors(none, none, {}), IsEmpty());
}

TEST(MatchDescriptors, RefusesWhatIsNoDescriptorSet) {
  const DescriptorSet good = RandomRootSift(3, 1);
  DescriptorSet torn = good, bright = good;
  torn.values.pop_back();
  bright.values[200] = 128;
  EXPECT_THROW((void)MatchDescriptors(torn, good, {}), std::logic_error);
  EXPECT_THROW((void)MatchDescriptors(good, bright, {}), std::logic_error);
}

TEST(MatchDescriptors, RefusesOptionsOutOfRange) {
  const DescriptorSet good = RandomRootSift(3, 1);
  EXPECT_THROW((void)MatchDescriptors(good, good, {.max_ratio = 1.01}), InvalidInputError);
  EXPECT_THROW((void)MatchDescriptors(good, good, {.max_distance = std::nan("")}),
               InvalidInputError);
}

}  // namespace
}  // namespace enfilade
