// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/model/tile_views.h"

namespace enfilade {
namespace {

constexpr int kRows = 6, kCols = 8;

Chart MakeChart() {
  Chart chart;
  chart.tile_rows = kRows;
  chart.tile_cols = kCols;
  return chart;
}

// Views that see every tile with the given log quality.
template <typename Quality>
ChartViews MakeViews(int num_views, const Quality& quality) {
  ChartViews views{std::vector<uint16_t>(kRows * kCols, kAllSamples), {}};
  for (int v = 0; v < num_views; ++v) {
    ChartView view{v, std::vector<TileView>(kRows * kCols)};
    for (int tile = 0; tile < kRows * kCols; ++tile) {
      view.tiles[static_cast<size_t>(tile)] = {
          kAllSamples, quality(v, tile / kCols, tile % kCols), {100, 100, 100}};
    }
    views.views.push_back(view);
  }
  return views;
}

std::vector<Eigen::Vector3d> Ones(size_t n) { return std::vector(n, Eigen::Vector3d(1, 1, 1)); }

TEST(ChooseViews, WithoutSeamCostEveryTileTakesItsBestView) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 3);
  std::vector<float> table(3 * kRows * kCols);
  for (float& value : table) value = uniform(random);
  const auto quality = [&](int v, int r, int c) {
    return table[static_cast<size_t>((v * kRows + r) * kCols + c)];
  };
  const std::vector<int> chosen = ChooseViews(MakeChart(), MakeViews(3, quality), Ones(3), 0);
  for (int tile = 0; tile < kRows * kCols; ++tile) {
    for (int v = 0; v < 3; ++v) {
      EXPECT_GE(quality(chosen[static_cast<size_t>(tile)], tile / kCols, tile % kCols),
                quality(v, tile / kCols, tile % kCols));
    }
  }
}

TEST(ChooseViews, ALoneTileFollowsItsNeighbours) {
  const auto quality = [](int v, int r, int c) {
    const bool is_lone = r == 3 && c == 4;
    return (v == 1) == is_lone ? 1.0F : 0.0F;
  };
  const std::vector<int> chosen = ChooseViews(MakeChart(), MakeViews(2, quality), Ones(2), 1.0);
  EXPECT_EQ(chosen, std::vector<int>(kRows * kCols, 0));
}

TEST(ChooseViews, OneStraightSeamBetweenTwoGoodHalves) {
  const auto quality = [](int v, int, int c) { return (v == 1) == (c >= 3) ? 2.0F : 0.0F; };
  const std::vector<int> chosen = ChooseViews(MakeChart(), MakeViews(2, quality), Ones(2), 1.0);
  for (int tile = 0; tile < kRows * kCols; ++tile) {
    EXPECT_EQ(chosen[static_cast<size_t>(tile)], tile % kCols >= 3 ? 1 : 0);
  }
}

TEST(ChooseViews, TilesNobodySeesHaveNoView) {
  ChartViews views = MakeViews(1, [](int, int, int) { return 0.0F; });
  views.views[0].tiles[5].seen = 0;
  const std::vector<int> chosen = ChooseViews(MakeChart(), views, Ones(1), 1.0);
  EXPECT_EQ(chosen[5], -1);
  EXPECT_EQ(chosen[4], 0);
  views.views.clear();
  EXPECT_EQ(ChooseViews(MakeChart(), views, {}, 1.0), std::vector<int>(kRows * kCols, -1));
}

TEST(ChooseViews, TheViewThatDisagreesLoses) {
  ChartViews views = MakeViews(3, [](int v, int, int) { return v == 0 ? 1.0F : 0.0F; });
  for (TileView& tile : views.views[0].tiles) tile.rgb = {20, 20, 20};
  const std::vector<int> chosen = ChooseViews(MakeChart(), views, Ones(3), 0.1);
  for (const int view : chosen) EXPECT_NE(view, 0);
}

TEST(EstimateGains, RecoversTheRatiosBehindOutliers) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(60, 150);
  ChartViews views = MakeViews(3, [](int, int, int) { return 0.0F; });
  const std::array<float, 3> exposure{1.0F, 1.3F, 0.85F};
  for (size_t tile = 0; tile < views.inside.size(); ++tile) {
    const Eigen::Vector3f truth(uniform(random), uniform(random), uniform(random));
    for (size_t v = 0; v < 3; ++v) views.views[v].tiles[tile].rgb = exposure[v] * truth;
    if (tile % 4 == 0) views.views[1].tiles[tile].rgb *= 0.5F;  // something else stands there
  }
  const std::vector<Eigen::Vector3d> gains = EstimateGains({views}, 3);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(gains[0][k] / gains[1][k], 1.3, 0.02);
    EXPECT_NEAR(gains[0][k] / gains[2][k], 0.85, 0.02);
  }
}

TEST(EstimateGains, ViewsThatShareNothingKeepTheirExposure) {
  EXPECT_EQ(EstimateGains({}, 2), Ones(2));
  EXPECT_TRUE(EstimateGains({}, 0).empty());
}

}  // namespace
}  // namespace enfilade
