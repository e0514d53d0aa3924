// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/gray_pyramid.h"

#include <gtest/gtest.h>

#include "tests/sfm/drawn_texture.h"

namespace enfilade {
namespace {

constexpr int kBorder = GrayLevel::kBorder_px;

// The grey level at a pixel of the picture; beyond it, of the border.
float GrayAt(const GrayLevel& level, int row, int col) {
  return level.gray(row + kBorder, col + kBorder);
}

TEST(GrayPyramid, PositionsHalveFromLevelToLevel) {
  ImageU8 ramp(80, 160);
  for (int r = 0; r < ramp.rows(); ++r) {
    for (int c = 0; c < ramp.cols(); ++c) ramp(r, c) = static_cast<uint8_t>(r + c);
  }
  RunContext context(1);
  const GrayPyramid pyramid(ramp, 3, false, context);
  ASSERT_EQ(pyramid.num_levels(), 3);
  // A ramp stays a ramp under symmetric filters: grey is x + y − 1 at positions (x, y) of level 0.
  for (int l = 0; l < 3; ++l) {
    const GrayLevel& level = pyramid.level(l);
    EXPECT_EQ(level.rows, 80 >> l);
    EXPECT_EQ(level.cols, 160 >> l);
    for (int r = 2; r < level.rows - 2; ++r) {
      for (int c = 2; c < level.cols - 2; ++c) {
        ASSERT_FLOAT_EQ(GrayAt(level, r, c), static_cast<float>((r + c + 1) * (1 << l) - 1));
      }
    }
  }
}

TEST(GrayPyramid, BordersRepeatTheEdgeOrContinueAllRound) {
  RunContext context(1);
  const ImageU8 image = DrawnTexture(2).Draw(32, 64);
  const GrayPyramid flat(image, 1, false, context), round(image, 1, true, context);
  for (int r = 0; r < 32; ++r) {
    for (int i = 1; i <= kBorder; ++i) {
      ASSERT_EQ(GrayAt(flat.level(0), r, -i), image(r, 0));
      ASSERT_EQ(GrayAt(flat.level(0), r, 63 + i), image(r, 63));
      ASSERT_EQ(GrayAt(round.level(0), r, -i), image(r, 64 - i));
      ASSERT_EQ(GrayAt(round.level(0), r, 63 + i), image(r, i - 1));
    }
  }
  EXPECT_EQ(GrayAt(flat.level(0), -kBorder, 5), image(0, 5));
  EXPECT_EQ(GrayAt(flat.level(0), 31 + kBorder, 5), image(31, 5));
}

// A panorama turned by whole pixels of the coarsest level has the same pyramid, turned.
TEST(GrayPyramid, WrappedLevelsHaveNoSeam) {
  RunContext context(1);
  const DrawnTexture texture(3, 128);
  const GrayPyramid still(texture.Draw(64, 128), 3, true, context),
      turned(texture.Draw(64, 128, {40, 0}), 3, true, context);
  for (int l = 0; l < 3; ++l) {
    const GrayLevel& level = still.level(l);
    for (int r = 0; r < level.rows; ++r) {
      for (int c = 0; c < level.cols; ++c) {
        ASSERT_NEAR(GrayAt(turned.level(l), r, (c + (40 >> l)) % level.cols), GrayAt(level, r, c),
                    1e-4)
            << l << ", " << r << ", " << c;
      }
    }
  }
}

TEST(GrayPyramid, ColoursBecomeLuma) {
  RunContext context(1);
  ImageU8 rgb(1, 2, 3);
  rgb(0, 0, 0) = 200, rgb(0, 0, 1) = 100, rgb(0, 0, 2) = 50;
  rgb(0, 1, 0) = rgb(0, 1, 1) = rgb(0, 1, 2) = 255;
  const GrayPyramid pyramid(rgb, 1, false, context);
  EXPECT_NEAR(GrayAt(pyramid.level(0), 0, 0), 0.299 * 200 + 0.587 * 100 + 0.114 * 50, 1e-4);
  EXPECT_NEAR(GrayAt(pyramid.level(0), 0, 1), 255, 1e-4);
}

TEST(GrayPyramid, LevelsEndWhereSidesAreShortOrOddInPanoramas) {
  RunContext context(1);
  const auto num_levels = [&](int rows, int cols, bool wraps_around) {
    return GrayPyramid(ImageU8(rows, cols), 9, wraps_around, context).num_levels();
  };
  EXPECT_EQ(num_levels(0, 0, false), 1);
  EXPECT_EQ(num_levels(1, 1, true), 1);
  EXPECT_EQ(num_levels(31, 400, false), 1);
  EXPECT_EQ(num_levels(64, 128, false), 3);
  EXPECT_EQ(num_levels(65, 135, false), 3);
  EXPECT_EQ(num_levels(128, 132, true), 3);
  EXPECT_EQ(num_levels(128, 135, true), 1);
}

TEST(GrayPyramid, IsTheSameForAnyNumberOfThreads) {
  RunContext one(1), three(3);
  const ImageU8 image = DrawnTexture(4).Draw(200, 150);
  const GrayPyramid a(image, 3, false, one), b(image, 3, false, three);
  for (int l = 0; l < 3; ++l) EXPECT_EQ(a.level(l).gray.data(), b.level(l).gray.data());
}

}  // namespace
}  // namespace enfilade
