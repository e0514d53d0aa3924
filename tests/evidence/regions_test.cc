// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evidence/regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace enfilade {
namespace {

ImageU8 MaskFromText(const std::vector<std::string>& rows) {
  ImageU8 mask(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int r = 0; r < mask.rows(); ++r) {
    for (int c = 0; c < mask.cols(); ++c) mask(r, c) = rows[r][c] == '#';
  }
  return mask;
}

TEST(LabelComponents, DiagonalContactCountsOnlyWithEightNeighbours) {
  const ImageU8 mask = MaskFromText({"##..",  //
                                     "..#.",  //
                                     "#..#"});
  EXPECT_THAT(LabelComponents(mask, Connectivity::kFour).num_cells,
              testing::ElementsAre(0, 2, 1, 1, 1));
  EXPECT_THAT(LabelComponents(mask, Connectivity::kEight).num_cells, testing::ElementsAre(0, 4, 1));
}

TEST(GrowLabels, FillsTheMaskFromTheNearestSeed) {
  const ImageU8 mask = MaskFromText({"#######.#"});
  ImageI seeds(1, 9);
  seeds(0, 0) = 2;
  seeds(0, 5) = 1;
  EXPECT_THAT(GrowLabels(seeds, mask).data(), testing::ElementsAre(2, 2, 2, 1, 1, 1, 1, 0, 0));
}

}  // namespace
}  // namespace enfilade
