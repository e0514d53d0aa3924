// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/angles.h"

#include <gtest/gtest.h>

#include <limits>

namespace enfilade {
namespace {

TEST(Angles, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(DegToRad(180), kPi);
  EXPECT_DOUBLE_EQ(RadToDeg(kPi / 4), 45);
  for (const double deg : {-720.0, -1.0, 0.0, 33.3})
    EXPECT_NEAR(RadToDeg(DegToRad(deg)), deg, 1e-12);
}

TEST(WrapPi, KnownAngles) {
  EXPECT_EQ(WrapPi(0), 0);
  EXPECT_EQ(WrapPi(kPi), -kPi);
  EXPECT_EQ(WrapPi(-kPi), -kPi);
  EXPECT_NEAR(WrapPi(3 * kPi / 2), -kPi / 2, 1e-15);
  EXPECT_NEAR(WrapPi(7), 7 - 2 * kPi, 1e-15);
}

// Law: the result is in [−p/2, p/2) and differs from the angle by a multiple of p.
template <typename Wrap>
void ExpectWraps(Wrap wrap, double period) {
  for (int i = -2000; i <= 2000; ++i) {
    const double angle = i * 0.0173;
    const double wrapped = wrap(angle);
    EXPECT_GE(wrapped, -period / 2);
    EXPECT_LT(wrapped, period / 2);
    EXPECT_NEAR(std::remainder(angle - wrapped, period), 0, 1e-12);
  }
}

TEST(WrapPi, Law) { ExpectWraps(WrapPi, 2 * kPi); }
TEST(WrapQuarter, Law) { ExpectWraps(WrapQuarter, kPi / 2); }

TEST(WrapPi, HalfOpenAtTheLastBit) {
  const double just_below = std::nextafter(-kPi, -4.0);
  EXPECT_GE(WrapPi(just_below), -kPi);
  EXPECT_LT(WrapPi(just_below), kPi);
  const double quarter = kPi / 4;
  for (const double angle : {quarter, -quarter, std::nextafter(-quarter, -1.0),
                             std::nextafter(quarter, 1.0), 3 * quarter}) {
    EXPECT_GE(WrapQuarter(angle), -quarter);
    EXPECT_LT(WrapQuarter(angle), quarter);
  }
}

TEST(WrapPi, NanStaysNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(WrapPi(nan)));
  EXPECT_TRUE(std::isnan(WrapQuarter(nan)));
}

}  // namespace
}  // namespace enfilade
