// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the paper's method, one by one.
#include <gtest/gtest.h>

#include "enfilade/floorplan/cells.h"
#include "src/floorplan/grid_window.h"
#include "src/floorplan/paper_anchors.h"
#include "src/floorplan/paper_contour.h"
#include "src/floorplan/paper_field.h"
#include "src/floorplan/paper_legs.h"
#include "tests/floorplan/drawn_evidence.h"

namespace enfilade {
namespace {

ImageU8 CellsFromText(const std::vector<std::string>& rows_from_top) {
  ImageU8 cells(static_cast<int>(rows_from_top.size()), static_cast<int>(rows_from_top[0].size()));
  for (int row = 0; row < cells.rows(); ++row) {
    for (int col = 0; col < cells.cols(); ++col) {
      cells(cells.rows() - 1 - row, col) =
          rows_from_top[static_cast<size_t>(row)][static_cast<size_t>(col)] == '#';
    }
  }
  return cells;
}

TEST(TraceContour, GoesOnceRoundCounterClockwise) {
  const ImageU8 cells = CellsFromText({".....", ".###.", ".#...", ".##..", "....."});
  const std::vector<GridVertex> contour = TraceContour(cells);
  const ImageU8 inside = CellsInside(5, 5, contour);
  EXPECT_EQ(inside.data(), cells.data());
  for (size_t i = 0; i < contour.size(); ++i) {
    const GridVertex &a = contour[i], &b = contour[(i + 1) % contour.size()];
    EXPECT_EQ(std::abs(a.row - b.row) + std::abs(a.col - b.col), 1);
  }
  EXPECT_TRUE(TraceContour(ImageU8(3, 3)).empty());
}

TEST(TraceContour, StaysWithItsCellWhereTwoMeetAtACorner) {
  const ImageU8 cells = CellsFromText({"......", ".##...", ".#.##.", ".####.", "......"});
  const std::vector<GridVertex> contour = TraceContour(cells);
  EXPECT_EQ(CellsInside(5, 6, contour).data(), cells.data());
}

ImageU8 CellsOfCores(const EvidenceGrids& grids) {
  return CellsWhere(grids.core, [](int core) { return core != 0; });
}

TEST(PaperField, AStepCostsWhereNeitherCellBesideItHasEnoughPoints) {
  EvidenceGrids grids = DrawCounts({Box(0, 0, 1, 1)}, {});
  std::fill(grids.wall.data().begin(), grids.wall.data().end(), 0.0F);
  grids.wall(10, 10) = 4;
  grids.wall(10, 12) = 3.9F;
  PaperOptions options;
  options.wall_points_per_m = 4 / grids.frame.cell_m;
  const PaperField field = MakePaperField(grids, options);
  const GridLoopProblem problem =
      MakePaperProblem(field, CellsOfCores(grids), ImageU8(grids.frame.rows, grids.frame.cols), 1);
  const auto cost = [&](int row, int col, GridHeading heading) {
    return static_cast<int>(problem.step_cost[problem.StepIndex(row, col, heading)]);
  };
  for (const int row : {10, 11}) {
    EXPECT_EQ(cost(row, 10, GridHeading::kEast), 0);
    EXPECT_EQ(cost(row, 11, GridHeading::kWest), 0);
    EXPECT_EQ(cost(row, 12, GridHeading::kEast), kCostPerCell);
  }
  for (const int col : {10, 11}) {
    EXPECT_EQ(cost(10, col, GridHeading::kNorth), 0);
    EXPECT_EQ(cost(11, col, GridHeading::kSouth), 0);
  }
  EXPECT_EQ(cost(9, 10, GridHeading::kEast), kCostPerCell);
  EXPECT_EQ(field.turn_cost, 5 * kCostPerCell) << "five cells of 2.5 cm";
}

TEST(PaperField, TheThresholdIsAMetreOfWallAndSoGrowsWithTheCell) {
  PaperOptions options;
  options.wall_points_per_m = 100;
  for (const double cell_m : {0.025, 0.05}) {
    const EvidenceGrids grids = DrawCounts({Box(0, 0, 1, 1)}, {}, {.cell_m = cell_m});
    const PaperField field = MakePaperField(grids, options);
    EXPECT_FLOAT_EQ(field.seen_points, static_cast<float>(100 * cell_m));
    EXPECT_EQ(field.turn_cost, std::lround(0.125 / cell_m * kCostPerCell));
  }
}

TEST(ClosedFreeSpace, FillsFanGapsAndHolesButNotWallsNorOtherCores) {
  EvidenceGrids grids =
      DrawCounts({Box(0, 0, 3, 2), Box(3.1, 0, 5, 2)}, {{1, 1}}, {.core_distance_m = 0.5});
  for (int col = grids.frame.Col(0.5); col < grids.frame.Col(2.5); col += 5) {
    for (int row = 0; row < grids.frame.rows; ++row) grids.free(row, col) = 0;  // between rays
  }
  EraseEvidence(Box(1.2, 1.4, 1.6, 1.6), grids);  // a hole
  const PaperField field = MakePaperField(grids, {});
  const int left = grids.core(grids.frame.Row(1), grids.frame.Col(1));
  const ImageU8 core = CellsWhere(grids.core, [&](int at_cell) { return at_cell == left; });
  const ImageU8 region = ClosedFreeSpace(field, core, ImageU8(grids.frame.rows, grids.frame.cols));
  const auto at = [&](double x, double y) {
    return static_cast<int>(region(grids.frame.Row(y), grids.frame.Col(x)));
  };
  EXPECT_EQ(at(0.51, 1), 1);
  EXPECT_EQ(at(1.4, 1.5), 1);
  EXPECT_EQ(at(3.05, 1), 0);
  EXPECT_EQ(at(4, 1), 0);
  EXPECT_EQ(CellsInside(region.rows(), region.cols(), TraceContour(region)).data(), region.data());
}

class Room : public testing::Test {
 protected:
  EvidenceGrids grids = DrawCounts({Box(0, 0, 4, 3)}, {{2, 1.5}});
  PaperField field = MakePaperField(grids, {});
  ImageU8 core = CellsOfCores(grids);
  ImageU8 none = ImageU8(grids.frame.rows, grids.frame.cols);
};

TEST_F(Room, LegsCostTheirUnseenStepsAndCorners) {
  const LegSolver legs(field, core, none);
  const auto vertex = [&](double x, double y) {
    return GridVertex{static_cast<int>(std::lround((y - grids.frame.origin.y()) / 0.025)),
                      static_cast<int>(std::lround((x - grids.frame.origin.x()) / 0.025))};
  };
  const GridPass low{vertex(1, 0), GridHeading::kEast}, low_right{vertex(3, 0), GridHeading::kEast},
      right{vertex(4, 1), GridHeading::kNorth};
  EXPECT_EQ(legs.Cost(low, low_right), 0);
  EXPECT_EQ(legs.Cost(low, right), field.turn_cost);
  EXPECT_GE(legs.Cost(low_right, low), 4 * field.turn_cost) << "backwards it has to turn round";
}

TEST_F(Room, TheGuidePassesTheAnchorsInOrderAndIsMadeOfStraightRuns) {
  const std::vector<GridVertex> contour = TraceContour(ClosedFreeSpace(field, core, none));
  const AnchorScene scene{field, grids.cameras, core, none, none, contour};
  const std::vector<WallAnchor> anchors = FindAnchors(scene, {});
  ASSERT_GE(anchors.size(), 8u);
  std::vector<int> idx;
  const std::vector<GridVertex> guide = MakeGuide(contour, anchors, idx);
  ASSERT_EQ(idx.size(), anchors.size());
  for (size_t i = 0; i < idx.size(); ++i) {
    EXPECT_EQ(guide[static_cast<size_t>(idx[i])], anchors[i].vertex);
    if (i > 0) {
      EXPECT_LT(idx[i - 1], idx[i]);
    }
  }
  for (size_t i = 0; i < guide.size(); ++i) {
    const GridVertex &a = guide[i], &b = guide[(i + 1) % guide.size()];
    EXPECT_TRUE((a.row == b.row) != (a.col == b.col));
  }
}

}  // namespace
}  // namespace enfilade
