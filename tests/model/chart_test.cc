// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/chart.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "enfilade/model/extrude.h"
#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

TEST(MakeCharts, MapsFacesAtScaleAndUnmirrored) {
  const BuildingModel model =
      ExtrudeFloorplan(MakePlan({MakeRoom(0, "1,1 5,1 5,3 3,3 3,4.5 1,4.5")}));
  const std::vector<Chart> charts = MakeCharts(model, {.texels_per_m = 40});
  ASSERT_EQ(charts.size(), model.faces.size());
  for (size_t f = 0; f < charts.size(); ++f) {
    const ModelFace& face = model.faces[f];
    // Right × up points at who looks at the face.
    EXPECT_NEAR((charts[f].right.cross(-charts[f].down) - face.normal).norm(), 0, 1e-12);
    for (const Eigen::Vector3d& p : face.vertices) {
      const Eigen::Vector2d texel = charts[f].TexelOf(p);
      EXPECT_GE(texel.minCoeff(), -1e-9);
      EXPECT_LE(texel.x(), charts[f].cols + 1e-9);
      EXPECT_LE(texel.y(), charts[f].rows + 1e-9);
      EXPECT_NEAR((charts[f].PointAt(texel.x(), texel.y()) - p).norm(), 0, 1e-9);
    }
  }
  EXPECT_EQ(charts[0].cols, 160);
  EXPECT_EQ(charts[0].rows, 140);
}

TEST(MakeCharts, InsideFollowsThePolygon) {
  const BuildingModel model = ExtrudeFloorplan(
      MakePlan({MakeRoom(0, "0,0 4,0 4,2 2,2 2,4 0,4", {"0.5,0.5 0.5,1 1,1 1,0.5"})}));
  const Chart chart = MakeCharts(model, {.texels_per_m = 50})[0];
  double num_inside = 0;
  for (const uint8_t inside : chart.is_inside.data()) num_inside += inside;
  // The polygon's area, with a rim of half a texel.
  EXPECT_NEAR(num_inside / 2500, 11.75, 0.5 * 0.02 * (16 + 2) + 0.02);
  EXPECT_EQ(chart.is_inside(10, 190), 0);  // up is +y: the missing quarter is at the top right
  EXPECT_EQ(chart.is_inside(190, 190), 1);
  EXPECT_EQ(chart.is_inside(200 - 38, 38), 0);  // the hole
}

TEST(PackCharts, ChartsWithTheirPaddingNeitherOverlapNorLeaveTheAtlas) {
  std::vector<Room> rooms;
  for (int i = 0; i < 9; ++i) {
    Room room = MakeRoom(i, "0,0 2,0 2,1 0,1");
    for (Eigen::Vector2d& p : room.polygon.outer) p *= 0.7 + 0.4 * i;
    rooms.push_back(room);
  }
  const TextureOptions options{.texels_per_m = 60, .atlas_px = 300};
  std::vector<Chart> charts = MakeCharts(ExtrudeFloorplan(MakePlan(rooms)), options);
  const std::vector<AtlasSize> atlases = PackCharts(options.atlas_px, charts);
  EXPECT_GT(atlases.size(), 3u);
  std::vector<ImageU8> taken;
  for (const AtlasSize& size : atlases) {
    EXPECT_LE(size.rows, options.atlas_px);
    EXPECT_LE(size.cols, options.atlas_px);
    taken.emplace_back(size.rows, size.cols);
  }
  for (const Chart& chart : charts) {
    ImageU8& atlas = taken.at(static_cast<size_t>(chart.atlas_idx));
    const int r0 = chart.atlas_row - kChartPadding_px, c0 = chart.atlas_col - kChartPadding_px;
    const int r1 = chart.atlas_row + chart.rows + kChartPadding_px;
    const int c1 = chart.atlas_col + chart.cols + kChartPadding_px;
    ASSERT_TRUE(r0 >= 0 && c0 >= 0 && r1 <= atlas.rows() && c1 <= atlas.cols());
    for (int r = r0; r < r1; ++r) {
      for (int c = c0; c < c1; ++c) ASSERT_EQ(atlas(r, c)++, 0);
    }
  }
}

}  // namespace
}  // namespace enfilade
