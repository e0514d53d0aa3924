// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/label_tint.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(TintByLabels, ColoursWhatIsKnownInTheSizeOfTheLabels) {
  ImageU8 labels(1, 4);
  for (int c = 0; c < 4; ++c) labels(0, c) = static_cast<uint8_t>(c);
  const ImageU8 tinted = TintByLabels(ImageU8(2, 8, 3, 100), labels);
  EXPECT_EQ(tinted.data(), (std::vector<uint8_t>{100, 100, 100,   // not known
                                                 80, 150, 80,     // floor
                                                 150, 80, 80,     // wall
                                                 80, 80, 160}));  // ceiling
}

}  // namespace
}  // namespace enfilade
