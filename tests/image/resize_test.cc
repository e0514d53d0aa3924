// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/resize.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(ReduceImage, TakesTheMeanOfWhatAPixelCovers) {
  ImageU8 image(2, 4, 3);
  for (int col = 0; col < 4; ++col) {
    for (int row = 0; row < 2; ++row) {
      image(row, col, 0) = static_cast<uint8_t>(40 * col);
      image(row, col, 1) = static_cast<uint8_t>(100 * row);
      image(row, col, 2) = 7;
    }
  }
  const ImageU8 reduced = ReduceImage(image, 1, 2);
  ASSERT_EQ(reduced.rows(), 1);
  ASSERT_EQ(reduced.cols(), 2);
  EXPECT_EQ(reduced.data(), (std::vector<uint8_t>{20, 50, 7, 100, 50, 7}));
  EXPECT_EQ(ReduceImage(image, 2, 4).data(), image.data());
  EXPECT_EQ(ReduceImage(ImageU8(8, 8, 1, 9), 3, 5).data(), ImageU8(3, 5, 1, 9).data());
}

}  // namespace
}  // namespace enfilade
