// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/explain.h"

#include <gtest/gtest.h>

#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "tests/evaluate/small_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

// A room of 4 × 3 m at 10 cm a cell with a camera, and the paper's trace of it.
class Explain : public testing::Test {
 protected:
  Explain() {
    Storey& plan_storey = plan_.storeys.emplace_back();
    plan_storey.rooms.emplace_back().polygon.outer = ParseRing("0,0 4,0 4,3 0,3");
    EvidenceGrids& grids = evidence_.emplace_back();
    grids.frame = {{-1, -1}, 0.1, 50, 60};
    grids.wall = ImageF(50, 60);
    grids.free = ImageF(50, 60);
    grids.core = CoreImage(50, 60);
    for (int row = 12; row < 38; ++row) {
      for (int col = 12; col < 48; ++col) {
        grids.free(row, col) = col < 24 ? 3 : 12;
        grids.core(row, col) = 1;
      }
    }
    for (int col = 10; col < 50; ++col) grids.wall(10, col) = 8;
    grids.cameras = {{0, {2, 1.5}}};
    PaperStorey& storey = paper_.emplace_back();
    storey.core = grids.core;
    PaperLoop& loop = storey.loops.emplace_back();
    loop.cut = {Eigen::Vector2d(3.75, 1.5), Eigen::Vector2d(4, 1.5)};
    loop.first_path = loop.second_path = loop.contour = plan_.storeys[0].rooms[0].polygon.outer;
    loop.anchors = {{{2, 0}, {1, 0}, 8}};
  }

  [[nodiscard]] static ImageU8 Render(const ExplainInput& input) {
    const TempFolder folder;
    WriteFileAtomic(folder / "explain.png", RenderExplainPng(input));
    return ReadImageRgb(folder / "explain.png");
  }

  Floorplan plan_;
  std::vector<EvidenceGrids> evidence_;
  std::vector<PaperStorey> paper_;
  SmallHome home_ = MakeSmallHome();
};

TEST_F(Explain, PanelsHaveOneScale) {
  const ImageU8 image = Render({plan_, evidence_, paper_, &home_.truth, {}});
  // 4.8 × 3.8 m with their border, 640 px wide; four panels a row, seven in all.
  EXPECT_EQ(image.cols(), 4 * 664 + 24);
  EXPECT_EQ(image.rows(), 2 * (507 + 68) + 24);
  const double px_per_m = 640 / 4.8;
  const auto pixel = [&](int row, int column, double x, double y, int channel) {
    const double left = 24 + 664 * column, top = 24 + 575 * row + 34;
    return static_cast<int>(image(static_cast<int>(top + 507 - px_per_m * (y + 0.4)),
                                  static_cast<int>(left + px_per_m * (x + 0.4)), channel));
  };
  EXPECT_GT(pixel(0, 0, 2, 0.05, 0), 200) << "high wall evidence is red";
  EXPECT_GT(pixel(0, 1, 0.8, 2.2, 2), 200) << "little free space is blue";
  EXPECT_GT(pixel(0, 1, 3, 2.2, 0), 200) << "much free space is red";
  EXPECT_NEAR(pixel(0, 2, 1, 2.2, 0), 204, 2) << "core is grey";
  EXPECT_LT(pixel(0, 2, 2, 1.5, 0), 80) << "a camera";
  EXPECT_GT(pixel(0, 3, 3.9, 1.5, 0), 200) << "the start and end line";
  EXPECT_LT(pixel(0, 3, 3.9, 1.5, 2), 80);
  EXPECT_LT(pixel(0, 3, 1, 3, 0), 100) << "the first path is blue";
  EXPECT_GT(pixel(1, 0, 2, 0, 1), pixel(1, 0, 2, 0, 0) + 50) << "an anchor is green";
  EXPECT_GT(pixel(1, 1, 1, 3, 0), pixel(1, 1, 1, 3, 2) + 80) << "the second path is red";
}

TEST_F(Explain, ShowsWhatThereIs) {
  const std::vector<PaperStorey> none;
  EXPECT_EQ(Render({plan_, evidence_, none, nullptr, {}}).cols(), 4 * 664 + 24);
  EXPECT_NO_THROW((void)RenderExplainPng({Floorplan{}, {}, {}, nullptr, {}}));
}

TEST_F(Explain, TheDrawingHasTheSizeOfThePicture) {
  const std::string svg = RenderExplainSvg({plan_, evidence_, paper_, nullptr, {}});
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("width=\"2680px\""), std::string::npos) << svg.substr(0, 400);
}

}  // namespace
}  // namespace enfilade
