// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/model_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/evaluate/error_map.h"
#include "enfilade/exchange/npy.h"
#include "enfilade/exchange/pixel_truth.h"
#include "enfilade/image/codec.h"
#include "enfilade/model/extrude.h"
#include "tests/evaluate/small_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

class ModelError : public testing::Test {
 protected:
  ModelError() { WritePixelTruth(folder_.path(), home_); }

  [[nodiscard]] ModelErrorMap Compare(const Floorplan& plan, size_t view_idx) const {
    const BuildingModel model = ExtrudeFloorplan(plan);
    return CompareModel(model, Visibility(model, plan), plan.home_from_world,
                        home_.truth.views[view_idx]);
  }

  TempFolder folder_;
  SmallHome home_ = MakeSmallHome();
};

TEST_F(ModelError, TruthAgainstItselfIsPerfect) {
  // The true doors are closed; the model sees through them, and the leaf is what fits.
  for (size_t i = 0; i < 3; ++i) {
    const ModelErrorMap map = Compare(home_.plan, i);
    EXPECT_EQ(map.figures.num_pixels, 64 * 32);
    EXPECT_EQ(map.figures.hit_share, 1.0);
    EXPECT_NEAR(*map.figures.depth_median_m, 0, 1e-5);
    EXPECT_EQ(map.figures.depth_within_5pct, 1.0);
    EXPECT_NEAR(*map.figures.normal_median_deg, 0, 1e-5);
    for (const float error : map.depth_error_m.data()) EXPECT_NEAR(error, 0, 1e-4);
    for (const float error : map.normal_error_deg.data()) EXPECT_NEAR(error, 0, 0.05);
  }
}

TEST_F(ModelError, AHigherCeilingShowsOnItsPixelsWithItsSign) {
  Floorplan plan = home_.plan;
  plan.storeys[0].rooms[0].ceiling_z += 0.1;
  const ModelErrorMap map = Compare(plan, 0);
  const ImageU8 labels = ReadTruthLabels(home_.truth.views[0].labels_path);
  const ImageF depth = ReadTruthDepth(home_.truth.views[0].depth_path);
  int num_ceiling = 0;
  for (int row = 0; row < 32; ++row) {
    for (int col = 0; col < 64; ++col) {
      const bool is_ceiling = labels(row, col) == static_cast<uint8_t>(SurfaceLabel::kCeiling);
      num_ceiling += is_ceiling;
      if (!is_ceiling) {
        EXPECT_NEAR(map.depth_error_m(row, col), 0, 1e-4);
      } else if (map.normal_error_deg(row, col) < 1) {  // still ceiling: 1 m becomes 1.1 m
        EXPECT_NEAR(map.depth_error_m(row, col), 0.1 * depth(row, col), 1e-4);
      }
    }
  }
  EXPECT_NEAR(*map.figures.depth_within_5pct, 1 - num_ceiling / (64.0 * 32), 0.02);
}

TEST_F(ModelError, FurnitureIsLeftOut) {
  ImageU8 labels = ReadTruthLabels(home_.truth.views[0].labels_path);
  for (int col = 0; col < 64; ++col) labels(20, col) = 0;
  WriteImage(home_.truth.views[0].labels_path, labels);
  const ModelErrorMap map = Compare(home_.plan, 0);
  EXPECT_EQ(map.figures.num_pixels, 64 * 31);
  EXPECT_TRUE(std::isnan(map.depth_error_m(20, 5)));
  EXPECT_GE(map.face_idx(20, 5), 0);
}

TEST_F(ModelError, AMissingRoomHasNoFaces) {
  Floorplan plan = home_.plan;
  plan.storeys[0].rooms.erase(plan.storeys[0].rooms.begin() + 1);
  const ModelErrorMap map = Compare(plan, 1);
  EXPECT_LT(*map.figures.hit_share, 0.1);
  EXPECT_TRUE(std::isinf(*map.figures.depth_median_m));
  EXPECT_LT(*map.figures.depth_within_5pct, 0.1);

  RunContext context(2);
  const BuildingModel model = ExtrudeFloorplan(plan);
  std::vector<int> seen(3, 0);
  const auto sink = [&](const ModelErrorMap& m) {
    ++seen.at(static_cast<size_t>(m.figures.view_idx));
  };
  const ModelErrorFigures all =
      EvaluateModel(model, plan, home_.truth, std::vector<int>{0, 1, 2}, {}, sink, context);
  EXPECT_EQ(seen, std::vector<int>({1, 1, 1}));
  EXPECT_EQ(all.hit_share, 1.0);  // the median of the three
  EXPECT_NEAR(*all.depth_median_m, 0, 1e-5);
  // One of one has none.
  const ModelErrorFigures lost =
      EvaluateModel(model, plan, home_.truth, std::vector<int>{-1, 1, -1}, {}, {}, context);
  EXPECT_EQ(lost.depth_median_m, std::nullopt);
}

TEST_F(ModelError, MapsAreNoWiderThanWanted) {
  const BuildingModel model = ExtrudeFloorplan(home_.plan);
  ModelErrorOptions options;
  options.map_width = 17;
  const ModelErrorMap map = CompareModel(model, Visibility(model, home_.plan),
                                         home_.plan.home_from_world, home_.truth.views[2], options);
  EXPECT_EQ(map.depth_error_m.cols(), 16);
  EXPECT_EQ(map.depth_error_m.rows(), 8);
  for (const float error : map.depth_error_m.data()) EXPECT_NEAR(error, 0, 1e-4);
}

TEST_F(ModelError, DepthOrNormalsAloneAreJudged) {
  home_.truth.views[0].normals_path.clear();
  home_.truth.views[1].depth_path.clear();
  const ModelErrorMap depth = Compare(home_.plan, 0), normals = Compare(home_.plan, 1);
  EXPECT_TRUE(depth.figures.depth_median_m);
  EXPECT_FALSE(depth.figures.normal_median_deg);
  EXPECT_FALSE(normals.figures.depth_median_m);
  EXPECT_TRUE(normals.figures.normal_median_deg);
}

TEST_F(ModelError, RefusesTruthOfDifferentSizes) {
  WriteNpy(home_.truth.views[0].normals_path, Image<int8_t>(16, 32, 3));
  EXPECT_THROW((void)Compare(home_.plan, 0), InvalidInputError);
}

TEST_F(ModelError, ThePictureShowsErrorsInTheirColours) {
  ModelErrorMap map = Compare(home_.plan, 0);
  for (int row = 16; row < 32; ++row) {
    for (int col = 0; col < 16; ++col) {
      map.depth_error_m(row, col) = 0.5F;
      map.depth_error_m(row, col + 16) = -0.5F;
      map.depth_error_m(row, col + 32) = std::nanf("");
      map.depth_error_m(row, col + 48) = INFINITY;
    }
  }
  WriteFileAtomic(folder_ / "map.png", RenderErrorMapPng(map, ImageU8(8, 16, 3, 90), "a.jpg"));
  const ImageU8 png = ReadImageRgb(folder_ / "map.png");
  // The second panel starts at 62 + 560; its lower half has four parts of 256 px.
  const auto pixel = [&](int part, int channel) {
    return static_cast<int>(png(62 + 560 + 384, 20 + 128 + 256 * part, channel));
  };
  EXPECT_GT(pixel(0, 0), pixel(0, 2) + 100);  // red: too far
  EXPECT_GT(pixel(1, 2), pixel(1, 0) + 100);  // blue: too near
  EXPECT_EQ(pixel(2, 0), pixel(2, 2));        // grey
  EXPECT_LT(pixel(3, 0) + pixel(3, 1) + pixel(3, 2), 10);
  EXPECT_EQ(png(62 + 560 + 100, 500, 1), 255);  // right is white
  EXPECT_EQ(RenderErrorMapPng(map, {}, "gone.jpg"), RenderErrorMapPng(map, {}, "gone.jpg"));
}

}  // namespace
}  // namespace enfilade
