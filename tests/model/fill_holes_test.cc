// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/fill_holes.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(FillHoles, KeepsWhatIsKnownAndStaysWithinItsRange) {
  ImageF image(37, 53, 4);
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.cols(); ++c) {
      if ((r - 18) * (r - 18) + (c - 26) * (c - 26) < 150) continue;
      for (int k = 0; k < 3; ++k) image(r, c, k) = static_cast<float>(c + 10 * k);
      image(r, c, 3) = 1;
    }
  }
  const ImageF before = image;
  ASSERT_TRUE(FillHoles(image));
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.cols(); ++c) {
      for (int k = 0; k < 3; ++k) {
        if (before(r, c, 3) > 0) {
          EXPECT_EQ(image(r, c, k), before(r, c, k));
        } else {
          // A ramp all round is continued roughly.
          EXPECT_NEAR(image(r, c, k), c + 10 * k, 10);
        }
      }
    }
  }
}

TEST(FillHoles, OnePixelColoursThePicture) {
  ImageF image(5, 9, 4);
  image(4, 8, 1) = 7;
  image(4, 8, 3) = 0.001F;
  ASSERT_TRUE(FillHoles(image));
  EXPECT_FLOAT_EQ(image(0, 0, 1), 7);
}

TEST(FillHoles, NothingKnownIsNoAnswer) {
  ImageF image(3, 1, 4);
  EXPECT_FALSE(FillHoles(image));
}

}  // namespace
}  // namespace enfilade
