// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/territories.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace enfilade {
namespace {

// A digit is a cell of that core; the first line is row 0.
EvidenceGrids GridsOf(const std::vector<std::string>& lines, int num_cores) {
  EvidenceGrids grids;
  grids.frame.rows = static_cast<int>(lines.size());
  grids.frame.cols = static_cast<int>(lines[0].size());
  grids.core = CoreImage(grids.frame.rows, grids.frame.cols);
  for (int row = 0; row < grids.frame.rows; ++row) {
    for (int col = 0; col < grids.frame.cols; ++col) {
      const char cell = lines[static_cast<size_t>(row)][static_cast<size_t>(col)];
      grids.core(row, col) = static_cast<uint16_t>(cell == '.' ? 0 : cell - '0');
    }
  }
  grids.num_cores = num_cores;
  return grids;
}

TEST(MapCores, TakesTheLargestPieceOfEveryCoreThatThereIs) {
  // Core 1 in pieces of two and four cells, touching core 3; no core 2; core 4 is not counted.
  const CoreMap map = MapCores(GridsOf({"11.....",   //
                                        "....33.",   //
                                        "..1133.",   //
                                        ".11...4"},  //
                                       3));
  ASSERT_EQ(map.windows.size(), 2u);
  const auto expect_window = [](const GridWindow& window, int row, int col, int rows, int cols) {
    EXPECT_EQ(window.row, row);
    EXPECT_EQ(window.col, col);
    EXPECT_EQ(window.rows, rows);
    EXPECT_EQ(window.cols, cols);
  };
  expect_window(map.windows[0], 2, 1, 2, 3);
  expect_window(map.windows[1], 1, 4, 2, 2);
  EXPECT_EQ(map.core_of_cell.data(), (std::vector<int>{-1, -1, -1, -1, -1, -1, -1,  //
                                                       -1, -1, -1, -1, 1,  1,  -1,  //
                                                       -1, -1, 0,  0,  1,  1,  -1,  //
                                                       -1, 0,  0,  -1, -1, -1, -1}));
}

TEST(GridWindow, GrowsAsFarAsTheGridGoes) {
  const GridWindow grown = GridWindow{1, 4, 2, 2}.Grown(3, 6, 8);
  EXPECT_EQ(grown.row, 0);
  EXPECT_EQ(grown.rows, 6);
  EXPECT_EQ(grown.col, 1);
  EXPECT_EQ(grown.cols, 7);
}

}  // namespace
}  // namespace enfilade
