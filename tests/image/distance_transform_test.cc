// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/distance_transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace enfilade {
namespace {

ImageU8 RandomMask(int rows, int cols, double density, std::mt19937& random) {
  std::bernoulli_distribution is_set(density);
  ImageU8 mask(rows, cols);
  for (uint8_t& value : mask.data()) value = is_set(random);
  return mask;
}

TEST(DistanceToMask, EqualsBruteForce) {
  std::mt19937 random(7);
  for (double density : {0.01, 0.1, 0.5}) {
    const ImageU8 mask = RandomMask(23, 31, density, random);
    const ImageF distance = DistanceToMask(mask);
    for (int r = 0; r < mask.rows(); ++r) {
      for (int c = 0; c < mask.cols(); ++c) {
        double nearest = std::numeric_limits<double>::infinity();
        for (int y = 0; y < mask.rows(); ++y) {
          for (int x = 0; x < mask.cols(); ++x) {
            if (mask(y, x) != 0) nearest = std::min(nearest, std::hypot(x - c, y - r));
          }
        }
        ASSERT_FLOAT_EQ(distance(r, c), static_cast<float>(nearest)) << r << " " << c;
      }
    }
  }
}

TEST(DistanceToMask, IsInfiniteWithoutMask) {
  EXPECT_EQ(DistanceToMask(ImageU8(2, 3)).data(),
            std::vector<float>(6, std::numeric_limits<float>::infinity()));
}

TEST(ErodeByDisc, TakesTheOutsideForZero) {
  const ImageU8 eroded = ErodeByDisc(ImageU8(5, 7, 1, 9), 1);
  for (int r = 0; r < 5; ++r) {
    for (int c = 0; c < 7; ++c) EXPECT_EQ(eroded(r, c), r > 0 && r < 4 && c > 0 && c < 6);
  }
}

TEST(OpenByDisc, RemovesWhatNoDiscFitsInAndNothingElse) {
  // A square with a tail one pixel wide: the tail goes, the square stays but for its corners.
  ImageU8 mask(20, 30);
  for (int r = 4; r < 16; ++r) {
    for (int c = 4; c < 16; ++c) mask(r, c) = 1;
  }
  for (int c = 16; c < 26; ++c) mask(9, c) = 1;
  const ImageU8 opened = OpenByDisc(mask, 2);
  EXPECT_EQ(opened(9, 20), 0);
  EXPECT_EQ(opened(9, 15), 1);
  EXPECT_EQ(opened(4, 9), 1);
  for (size_t i = 0; i < mask.data().size(); ++i) EXPECT_LE(opened.data()[i], mask.data()[i]);
  EXPECT_EQ(OpenByDisc(opened, 2).data(), opened.data());
}

}  // namespace
}  // namespace enfilade
