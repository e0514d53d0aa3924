// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/sampling.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace enfilade {
namespace {

// value = 10·col + row in channel 0, its negative in channel 1.
ImageF Ramp(int rows, int cols) {
  ImageF image(rows, cols, 2);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      image(r, c, 0) = static_cast<float>(10 * c + r);
      image(r, c, 1) = -image(r, c, 0);
    }
  }
  return image;
}

TEST(SampleBilinear, PixelCentresAreExact) {
  const ImageF image = Ramp(3, 4);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      EXPECT_EQ(SampleBilinear(image, c + 0.5, r + 0.5), image(r, c));
      EXPECT_EQ(SampleBilinearWrapped(image, c + 0.5, r + 0.5, 1), image(r, c, 1));
    }
  }
}

TEST(SampleBilinear, LinearFunctionsAreReproduced) {
  const ImageF image = Ramp(5, 6);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(0.5, 5.5), y(0.5, 4.5);
  for (int i = 0; i < 100; ++i) {
    const double px = x(random), py = y(random);
    const double expected = 10 * (px - 0.5) + (py - 0.5);
    EXPECT_NEAR(SampleBilinear(image, px, py), expected, 1e-4);
    EXPECT_NEAR(SampleBilinearWrapped(image, px, py), expected, 1e-4);
  }
}

TEST(SampleBilinear, ClampsAtTheBorder) {
  const ImageF image = Ramp(3, 4);
  EXPECT_EQ(SampleBilinear(image, -5, -5), image(0, 0));
  EXPECT_EQ(SampleBilinear(image, 0, 0), image(0, 0));
  EXPECT_EQ(SampleBilinear(image, 4, 3), image(2, 3));
  EXPECT_EQ(SampleBilinear(image, 1e9, 1e9), image(2, 3));
}

TEST(SampleBilinearWrapped, XWrapsAndYClamps) {
  const ImageF image = Ramp(3, 4);
  // Half way between the last and the first column.
  const float seam = 0.5f * (image(1, 3) + image(1, 0));
  EXPECT_EQ(SampleBilinearWrapped(image, 0.0, 1.5), seam);
  EXPECT_EQ(SampleBilinearWrapped(image, 4.0, 1.5), seam);
  EXPECT_EQ(SampleBilinearWrapped(image, 8.0, 1.5), seam);
  EXPECT_EQ(SampleBilinearWrapped(image, -4.0, 1.5), seam);
  EXPECT_EQ(SampleBilinearWrapped(image, 0.5, -3), image(0, 0));
  EXPECT_EQ(SampleBilinearWrapped(image, 0.5, 9), image(2, 0));
}

TEST(SampleBilinearWrapped, PeriodicIncludingTheLastBit) {
  const ImageF image = Ramp(3, 4);
  for (int i = -40; i < 40; ++i) {
    const double x = 0.31 * i;
    EXPECT_NEAR(SampleBilinearWrapped(image, x, 1.2), SampleBilinearWrapped(image, x + 4, 1.2),
                1e-4);
  }
  const double just_below = std::nextafter(0.5, 0.0);
  EXPECT_NEAR(SampleBilinearWrapped(image, just_below, 0.5), image(0, 0), 1e-4);
  EXPECT_NEAR(SampleBilinearWrapped(image, std::nextafter(4.5, 0.0), 0.5), image(0, 0), 1e-4);
}

TEST(SampleBilinear, OnePixel) {
  const ImageU8 image(1, 1, 1, 200);
  for (const double x : {-1.0, 0.0, 0.3, 0.5, 1.0, 7.0}) {
    EXPECT_EQ(SampleBilinear(image, x, x), 200);
    EXPECT_EQ(SampleBilinearWrapped(image, x, x), 200);
  }
}

}  // namespace
}  // namespace enfilade
