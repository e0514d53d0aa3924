// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixture_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "enfilade/synthetic/render.h"
#include "enfilade/synthetic/text_home.h"

namespace enfilade {
namespace {

constexpr auto kFloor = static_cast<uint8_t>(SurfaceLabel::kFloor);
constexpr auto kWall = static_cast<uint8_t>(SurfaceLabel::kWall);
constexpr auto kOther = static_cast<uint8_t>(SurfaceLabel::kOther);

LabelNoise Perfect() {
  LabelNoise noise;
  noise.boundary_sigma_deg = noise.blob_share = noise.furniture_as_wall_share = 0;
  return noise;
}

Home OneRoom() { return TextHome("room 0,0 5,0 5,4 0,4 | camera 2,1.5", {.baseboard_m = 0}); }

// First row of the floor in every column.
std::vector<double> FloorRows(const ImageU8& labels) {
  std::vector<double> rows;
  for (int col = 0; col < labels.cols(); ++col) {
    int row = labels.rows() / 2;
    while (labels(row, col) != kFloor) ++row;
    rows.push_back(row);
  }
  return rows;
}

TEST(FixtureLabels, WithoutNoiseTheyAreTheRenderers) {
  const Home home = TextHome(
      "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8 | window 1,0 2,0 | "
      "box 2.5,2 3.5,2.8 height 0.8 | camera 1,1.4 | camera 6,2");
  constexpr ImageSize kSize{128, 64};
  RenderOptions options;
  options.stand_share = 0;
  options.bounces = 0;
  options.samples_per_pixel = 1;
  options.light_cell_m = 0.5;
  RunContext context(1);
  const HomeRenderer renderer(home, options, context);
  for (const int i : {0, 1}) {
    EXPECT_EQ(FixtureLabels(home, i, kSize, Perfect()).data(),
              renderer.Render(i, kSize, context).label.data());
  }
}

TEST(FixtureLabels, BoundariesMoveAsFarAndAsSmoothlyAsAsked) {
  const Home home = OneRoom();
  constexpr ImageSize kSize{360, 720};  // 4 pixels a degree along the columns
  LabelNoise noise = Perfect();
  const std::vector<double> truth = FloorRows(FixtureLabels(home, 0, kSize, noise));
  noise.boundary_sigma_deg = 0.8;
  noise.correlation_deg = 3;
  double squares = 0, products = 0, count = 0;
  for (uint64_t seed = 0; seed < 3; ++seed) {
    noise.seed = seed;
    const std::vector<double> moved = FloorRows(FixtureLabels(home, 0, kSize, noise));
    for (size_t c = 0; c < moved.size(); ++c) {
      const size_t there = (c + 3) % moved.size();  // one correlation length away
      squares += std::pow(moved[c] - truth[c], 2);
      products += (moved[c] - truth[c]) * (moved[there] - truth[there]);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count) / 4, 0.8, 0.06);
  EXPECT_NEAR(products / squares, std::exp(-0.5), 0.08);
}

TEST(FixtureLabels, BlobsAreConfusedAsOftenAsAsked) {
  const Home home = OneRoom();
  constexpr ImageSize kSize{360, 180};
  LabelNoise noise = Perfect();
  const ImageU8 truth = FixtureLabels(home, 0, kSize, noise);
  noise.blob_share = 0.2;
  noise.blob_deg = 4;
  const ImageU8 confused = FixtureLabels(home, 0, kSize, noise);
  double num_changed = 0, num_borders = 0, num_structural = 0;
  for (int row = 0; row < kSize.height; ++row) {
    for (int col = 0; col < kSize.width; ++col) {
      if (truth(row, col) == kOther) continue;
      const auto is_changed = [&](int c) { return confused(row, c) != truth(row, c); };
      ++num_structural;
      num_changed += is_changed(col) ? 1 : 0;
      num_borders += is_changed(col) != is_changed((col + 1) % kSize.width) ? 1 : 0;
    }
  }
  EXPECT_NEAR(num_changed / num_structural, 0.2, 0.03);
  // Whole blobs: a border every few pixels, where single pixels would change at 32 % of the steps.
  EXPECT_LT(num_borders / num_structural, 0.1);
}

TEST(FixtureLabels, FurnitureBecomesWall) {
  const Home home = TextHome("room 0,0 4,0 4,3 0,3 | box 2,0.5 3.5,2.8 height 1.2 | camera 1,1.4");
  constexpr ImageSize kSize{128, 64};
  LabelNoise noise = Perfect();
  const ImageU8 truth = FixtureLabels(home, 0, kSize, noise);
  noise.furniture_as_wall_share = 1;
  const ImageU8 mistaken = FixtureLabels(home, 0, kSize, noise);
  for (size_t i = 0; i < truth.data().size(); ++i)
    EXPECT_EQ(mistaken.data()[i], truth.data()[i] == kOther ? kWall : truth.data()[i]);
}

}  // namespace
}  // namespace enfilade
