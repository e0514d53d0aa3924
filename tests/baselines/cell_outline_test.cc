// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/cell_outline.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {
namespace {

// Rows of text, the top one is the highest row: '#' set, other characters not.
ImageU8 ParseCells(const std::vector<std::string>& text) {
  ImageU8 cells(static_cast<int>(text.size()), static_cast<int>(text[0].size()));
  for (int row = 0; row < cells.rows(); ++row) {
    for (int col = 0; col < cells.cols(); ++col) {
      cells(row, col) =
          text[static_cast<size_t>(cells.rows() - 1 - row)][static_cast<size_t>(col)] == '#';
    }
  }
  return cells;
}

ImageU8 RandomCells(int rows, int cols, double share, std::mt19937& random) {
  ImageU8 cells(rows, cols);
  std::bernoulli_distribution is_set(share);
  for (uint8_t& cell : cells.data()) cell = is_set(random);
  return cells;
}

Ring2 RingOf(const std::vector<GridVertex>& vertices) {
  return RingInMetres({.cell_m = 1, .rows = 0, .cols = 0}, vertices);
}

bool HasCornerContact(const ImageU8& cells) {
  for (int row = 0; row + 1 < cells.rows(); ++row) {
    for (int col = 0; col + 1 < cells.cols(); ++col) {
      if (cells(row, col) == cells(row + 1, col + 1) &&
          cells(row, col + 1) == cells(row + 1, col) && cells(row, col) != cells(row, col + 1)) {
        return true;
      }
    }
  }
  return false;
}

TEST(TraceOutline, ARectangleHasFourCorners) {
  const ImageU8 cells = ParseCells({"....", ".##.", ".##.", ".##.", "...."});
  const CellOutline outline = TraceOutline(5, 4, ConnectedCells(cells).at(0));
  EXPECT_EQ(outline.outer, (std::vector<GridVertex>{{1, 1}, {1, 3}, {4, 3}, {4, 1}}));
  EXPECT_TRUE(outline.holes.empty());
}

TEST(TraceOutline, HolesAreClockwise) {
  const ImageU8 cells = ParseCells({"#####", "#.###", "###.#", "#####"});
  const CellOutline outline = TraceOutline(4, 5, ConnectedCells(cells).at(0));
  EXPECT_EQ(RingToText(RingOf(outline.outer)), "0,0 5,0 5,4 0,4");
  ASSERT_EQ(outline.holes.size(), 2u);
  for (const auto& hole : outline.holes) EXPECT_EQ(SignedArea(RingOf(hole)), -1);
}

// The rings have the area of the cells, enclose exactly these, are simple and share no vertex.
TEST(TraceOutline, EqualsTheCellsOnRandomGrids) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    ImageU8 cells = RandomCells(12, 14, 0.2 + 0.15 * (trial % 5), random);
    JoinCorners(cells);
    for (const CellSet& set : ConnectedCells(cells)) {
      const CellOutline outline = TraceOutline(12, 14, set);
      ImageU8 inside = CellsInside(12, 14, outline.outer);
      std::vector<std::vector<GridVertex>> rings = outline.holes;
      rings.push_back(outline.outer);
      std::set<std::pair<int, int>> vertices;
      size_t num_vertices = 0;
      for (const auto& ring : rings) {
        ASSERT_TRUE(IsSimple(RingOf(ring)));
        for (const GridVertex& vertex : ring) vertices.insert({vertex.row, vertex.col});
        num_vertices += ring.size();
      }
      EXPECT_EQ(vertices.size(), num_vertices);
      for (const auto& hole : outline.holes) {
        EXPECT_LT(SignedArea(RingOf(hole)), 0);
        const ImageU8 in_hole = CellsInside(12, 14, hole);
        for (size_t i = 0; i < inside.data().size(); ++i) inside.data()[i] ^= in_hole.data()[i];
      }
      EXPECT_EQ(ConnectedCells(inside), std::vector<CellSet>{set});
    }
  }
}

TEST(JoinCorners, LeavesNoCornerContactsAndTakesNothingAway) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const ImageU8 cells = RandomCells(15, 11, 0.5, random);
    ImageU8 joined = cells;
    JoinCorners(joined);
    EXPECT_FALSE(HasCornerContact(joined));
    for (size_t i = 0; i < cells.data().size(); ++i) EXPECT_LE(cells.data()[i], joined.data()[i]);
    ImageU8 again = joined;
    JoinCorners(again);
    EXPECT_EQ(again.data(), joined.data());
  }
}

TEST(FillSmallHoles, KeepsLargeOnesAndTheOutside) {
  ImageU8 cells = ParseCells({"......", "#####.", "#.#.#.", "#.###.", "#####."});
  FillSmallHoles(2, cells);
  EXPECT_EQ(cells.data(), ParseCells({"......", "#####.", "#.###.", "#.###.", "#####."}).data());
  FillSmallHoles(3, cells);
  EXPECT_EQ(cells.data(), ParseCells({"......", "#####.", "#####.", "#####.", "#####."}).data());
}

}  // namespace
}  // namespace enfilade
