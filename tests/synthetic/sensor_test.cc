// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

TEST(ExposeSensor, WithoutBlurAndNoiseOnlyRounds) {
  ImageF ideal(2, 4, 3, 10.4f);
  ideal(1, 3, 2) = 300;
  ideal(0, 0, 0) = -5;
  const ImageU8 out = ExposeSensor(ideal, 0, 0, true, 1);
  EXPECT_EQ(out(0, 1, 0), 10);
  EXPECT_EQ(out(1, 3, 2), 255);
  EXPECT_EQ(out(0, 0, 0), 0);
}

TEST(ExposeSensor, BlurWrapsRoundTheColumnsAndKeepsTheSum) {
  ImageF ideal(9, 16, 1);
  ideal(4, 0) = 250;
  const ImageU8 out = ExposeSensor(ideal, 0.8, 0, true, 1);
  EXPECT_EQ(out(4, 1), out(4, 15));
  EXPECT_EQ(out(3, 0), out(5, 0));
  EXPECT_GT(out(4, 15), 10);
  int sum = 0;
  for (const uint8_t value : out.data()) sum += value;
  EXPECT_NEAR(sum, 250, 8);
}

TEST(ExposeSensor, BlurOfAViewEndsAtItsBorder) {
  ImageF ideal(9, 16, 1);
  ideal(4, 0) = 250;
  const ImageU8 out = ExposeSensor(ideal, 0.8, 0, false, 1);
  EXPECT_GT(out(4, 1), 10);
  EXPECT_EQ(out(4, 15), 0);
}

TEST(ExposeSensor, NoiseHasTheAskedSize) {
  const ImageU8 out = ExposeSensor(ImageF(100, 200, 3, 128.0f), 0, 2.0, true, 3);
  double squares = 0;
  for (const uint8_t value : out.data()) squares += std::pow(value - 128.0, 2);
  // Rounding adds a variance of 1/12.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(out.data().size())), std::sqrt(4 + 1 / 12.0),
              0.03);
}

}  // namespace
}  // namespace enfilade
