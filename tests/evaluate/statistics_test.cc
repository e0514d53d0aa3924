// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/statistics.h"

#include <gtest/gtest.h>

#include <limits>

namespace enfilade {
namespace {

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_EQ(Quantile({3, 1, 2, 4}, 0.5), 2.5);
  EXPECT_EQ(Quantile({3, 1, 2}, 0.5), 2.0);
  EXPECT_EQ(Quantile({0, 10}, 0.95), 9.5);
  EXPECT_EQ(Quantile({7}, 0.95), 7.0);
}

TEST(Quantile, IsNoneForNothingAndForInfinity) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Quantile({}, 0.5), std::nullopt);
  EXPECT_EQ(Quantile({1, infinity, infinity}, 0.5), std::nullopt);
  EXPECT_EQ(Quantile({1, 1, 1, infinity}, 0.5), 1.0);
}

TEST(Mean, OfNothingIsNone) {
  EXPECT_EQ(Mean({}), std::nullopt);
  EXPECT_EQ(Mean({1, 2, 6}), 3.0);
}

}  // namespace
}  // namespace enfilade
