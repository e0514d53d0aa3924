// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/image.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(Image, RowsOfInterleavedValues) {
  Image<int> image(2, 3, 2, 7);
  EXPECT_EQ(image.rows(), 2);
  EXPECT_EQ(image.cols(), 3);
  EXPECT_EQ(image.channels(), 2);
  EXPECT_EQ(image.data(), std::vector<int>(12, 7));
  image(1, 2, 1) = 5;
  EXPECT_EQ(image.data().back(), 5);
  image(1, 0) = 3;
  EXPECT_EQ(image.data()[6], 3);
  EXPECT_EQ(image.row(1), image.data().data() + 6);
  const Image<int>& constant = image;
  EXPECT_EQ(constant(1, 2, 1), 5);
  EXPECT_EQ(constant.row(1)[0], 3);
}

TEST(Image, Empty) {
  EXPECT_TRUE(ImageU8().empty());
  EXPECT_TRUE(ImageU8(0, 5).empty());
  EXPECT_EQ(ImageF(2, 2)(1, 1), 0.0f);
}

TEST(Image, NegativeSizesAreBugs) {
  EXPECT_THROW(ImageU8(-1, 5), std::logic_error);
  EXPECT_THROW(ImageU8(5, -1), std::logic_error);
  EXPECT_THROW(ImageU8(5, 5, 0), std::logic_error);
}

}  // namespace
}  // namespace enfilade
