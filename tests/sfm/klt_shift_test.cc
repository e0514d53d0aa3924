// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/klt_shift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sfm/drawn_texture.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

Vector2d ShiftBetween(const ImageU8& first, const ImageU8& second, bool wraps_around) {
  RunContext context(1);
  return ShiftOfPicture(GrayPyramid(first, 3, wraps_around, context),
                        GrayPyramid(second, 3, wraps_around, context));
}

// Thumbnails of 200 × 260 pixels at a quarter are 50 × 33 pixels of 8: 4 pixels are half of one.
TEST(ShiftOfPicture, IsRightToHalfAPixelOfTheThumbnailForAllGains) {
  const DrawnTexture texture(1);
  const ImageU8 first = texture.Draw(200, 260);
  for (const Vector2d& shift : {Vector2d(64, 0), Vector2d(-51, 22), Vector2d(13, -37)}) {
    for (const double gain : {0.6, 1.0, 1.3}) {
      const Vector2d found = ShiftBetween(first, texture.Draw(200, 260, shift, gain), false);
      EXPECT_LE((found - shift).cwiseAbs().maxCoeff(), 4.5) << shift.transpose() << ", " << gain;
    }
  }
}

TEST(ShiftOfPicture, GoesAllRoundAPanorama) {
  const DrawnTexture texture(2, 256);
  const ImageU8 first = texture.Draw(128, 256);
  for (const double shift : {0.0, 40.0, 120.0, -88.0}) {
    const Vector2d found = ShiftBetween(first, texture.Draw(128, 256, {shift, 0}, 0.8), true);
    EXPECT_LE(std::abs(std::remainder(found.x() - shift, 256)), 4.5) << shift;
    EXPECT_EQ(found.y(), 0);
  }
}

TEST(ShiftOfPicture, IsZeroWhereNothingIsBetter) {
  const ImageU8 image = DrawnTexture(3).Draw(100, 100);
  EXPECT_EQ(ShiftBetween(image, image, false), Vector2d(0, 0));
  EXPECT_EQ(ShiftBetween(image, ImageU8(100, 100), false), Vector2d(0, 0));
  EXPECT_EQ(ShiftBetween(ImageU8(), ImageU8(), false), Vector2d(0, 0));
  EXPECT_EQ(ShiftBetween(ImageU8(2, 3), ImageU8(2, 3), true), Vector2d(0, 0));
}

}  // namespace
}  // namespace enfilade
