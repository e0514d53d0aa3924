// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/column_scores.h"
#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

const std::vector<int> kMatches = {0, 1, 2};

ColumnFigures Judge(const SmallHome& home, const std::vector<int>& matches = kMatches) {
  return EvaluateColumns(home.scene, home.structure, home.truth, matches);
}

TEST(EvaluateColumns, TruthAgainstItselfIsPerfect) {
  const ColumnFigures figures = Judge(MakeSmallHome());
  ASSERT_EQ(figures.panoramas.size(), 3U);
  EXPECT_NEAR(*figures.error_median_deg, 0, 1e-4);
  EXPECT_NEAR(*figures.relative_error_median, 0, 1e-6);
  EXPECT_NEAR(*figures.error_median_m, 0, 1e-6);
  EXPECT_EQ(figures.within_5pct, 1.0);
  EXPECT_EQ(figures.within_10pct, 1.0);
  EXPECT_GT(*figures.iou_median, 0.998);  // 360 columns cut the corners
  EXPECT_NEAR(*figures.ceiling_error_median_m, 0, 1e-12);
}

TEST(EvaluateColumns, LeavesOutColumnsThroughDoors) {
  SmallHome home = MakeSmallHome();
  const Eigen::Vector2d camera(1.3, 1.2);
  // In room 0 the wall y = 3 has its door at x 1.0 … 1.9, annotated 5 cm behind the wall.
  const double left = std::atan2(3.05 - camera.y(), 1.0 - camera.x());
  const double right = std::atan2(3.05 - camera.y(), 1.9 - camera.x());
  const double door_columns = (left - right) / (2 * kPi) * 360;
  const int judged = Judge(home).panoramas[0].num_columns;
  EXPECT_NEAR(360 - judged, door_columns, 1.0);
  // What such columns say changes nothing.
  for (int c = 0; c < 360; ++c) {
    const double azimuth = WrapPi(AzimuthOfColumn(c, 360) + home.structure.heading_rad);
    if (azimuth < left && azimuth > right)
      home.structure.profiles[0].wall_m[static_cast<size_t>(c)] = 9;
  }
  EXPECT_EQ(Judge(home).panoramas[0].within_5pct, 1.0);
}

TEST(EvaluateColumns, KeepsColumnsWhoseDoorIsHiddenBehindTheWall) {
  SmallHome home = MakeSmallHome();
  home.truth.views[0].doors = {{Eigen::Vector2d(6, 0), Eigen::Vector2d(6, 3)}};
  EXPECT_EQ(Judge(home).panoramas[0].num_columns, 360);
}

TEST(EvaluateColumns, KnownErrorsGiveKnownFigures) {
  SmallHome home = MakeSmallHome();
  home.truth.views[0].doors.clear();
  const std::vector<float> truth = home.structure.profiles[0].wall_m;
  std::vector<double> errors_deg;
  for (size_t c = 0; c < truth.size(); ++c) {
    home.structure.profiles[0].wall_m[c] = truth[c] * (c % 4 == 0 ? 1.20F : 1.07F);
    errors_deg.push_back(RadToDeg(std::abs(std::atan(1.4 / home.structure.profiles[0].wall_m[c]) -
                                           std::atan(1.4 / truth[c]))));
  }
  std::sort(errors_deg.begin(), errors_deg.end());
  home.structure.profiles[0].ceiling_z += 0.06;
  const PanoramaFigures figures = Judge(home).panoramas[0];
  EXPECT_NEAR(*figures.relative_error_median, 0.07, 1e-5);
  EXPECT_EQ(figures.within_5pct, 0.0);
  EXPECT_EQ(figures.within_10pct, 0.75);
  EXPECT_NEAR(*figures.error_median_deg, 0.5 * (errors_deg[179] + errors_deg[180]), 1e-4);
  EXPECT_NEAR(*figures.ceiling_error_m, 0.06, 1e-9);
  // The area grows by 3/4 · 1.07² + 1/4 · 1.2², less what the zigzag of the columns loses.
  EXPECT_LT(*figures.iou, 1 / (1.07 * 1.07));
  EXPECT_GT(*figures.iou, 1 / (1.2 * 1.2));
}

TEST(EvaluateColumns, MedianOverPanoramasIsNotMovedByOneBadOne) {
  SmallHome home = MakeSmallHome();
  for (float& r : home.structure.profiles[1].wall_m) r *= 2;
  const ColumnFigures figures = Judge(home);
  EXPECT_EQ(figures.panoramas[1].within_10pct, 0.0);
  EXPECT_EQ(figures.within_10pct, 1.0);
  EXPECT_NEAR(*figures.relative_error_median, 0, 1e-6);
  EXPECT_NEAR(*figures.iou_mean, (2 + 0.25) / 3, 0.01);
}

TEST(EvaluateColumns, AnErrorOfThePoseDoesNotCount) {
  SmallHome home = MakeSmallHome();
  const Rigid3 shift{RotationZ(0.3), {5, -2, 0}};
  for (View& view : home.scene.views) view.world_from_cam = shift * view.world_from_cam;
  // The home frame follows the shifted world, so that the profiles stay what the cameras saw.
  home.structure.home_from_world.rotation =
      home.structure.home_from_world.rotation * shift.rotation.transpose();
  EXPECT_EQ(Judge(home).within_5pct, 1.0);
  EXPECT_NEAR(*Judge(home).error_median_deg, 0, 1e-4);
}

TEST(EvaluateColumns, ATurnedProfileIsWrong) {
  SmallHome home = MakeSmallHome();
  for (WallProfile& profile : home.structure.profiles) {
    std::rotate(profile.wall_m.begin(), profile.wall_m.begin() + 10, profile.wall_m.end());
  }
  EXPECT_LT(*Judge(home).within_5pct, 0.7);
}

TEST(EvaluateColumns, ColumnsWithoutADistanceCountAsWrong) {
  SmallHome home = MakeSmallHome();
  home.truth.views[0].doors.clear();
  std::vector<float>& wall_m = home.structure.profiles[0].wall_m;
  for (size_t c = 0; c < 90; ++c) wall_m[c] = std::numeric_limits<float>::quiet_NaN();
  for (size_t c = 90; c < 180; ++c) wall_m[c] = 0;
  const PanoramaFigures figures = Judge(home).panoramas[0];
  EXPECT_EQ(figures.num_columns, 360);
  EXPECT_EQ(figures.within_10pct, 0.5);
  EXPECT_EQ(figures.iou, std::nullopt);
}

TEST(EvaluateColumns, ColumnsThatThePictureDoesNotCoverAreLeftOut) {
  SmallHome home = MakeSmallHome();
  home.truth.views[0].doors.clear();
  WallProfile& profile = home.structure.profiles[0];
  std::fill(profile.is_seen.begin(), profile.is_seen.begin() + 300, uint8_t{0});
  std::fill(profile.wall_m.begin(), profile.wall_m.begin() + 300, 0.0F);
  const PanoramaFigures figures = Judge(home).panoramas[0];
  EXPECT_EQ(figures.num_columns, 60);
  EXPECT_EQ(figures.within_5pct, 1.0);
  EXPECT_EQ(figures.iou, std::nullopt);
}

TEST(EvaluateColumns, JudgesOnlyMatchedPanoramasInsideTheirLayout) {
  SmallHome home = MakeSmallHome();
  home.truth.views[1].is_inside = false;
  const ColumnFigures figures = Judge(home, {0, 1, -1});
  ASSERT_EQ(figures.panoramas.size(), 1U);
  EXPECT_EQ(figures.panoramas[0].picture, "picture_0.jpg");
}

TEST(EvaluateColumns, NothingToJudgeGivesNone) {
  const ColumnFigures figures = Judge(MakeSmallHome(), {-1, -1, -1});
  EXPECT_TRUE(figures.panoramas.empty());
  EXPECT_EQ(figures.error_median_deg, std::nullopt);
  EXPECT_EQ(figures.within_5pct, std::nullopt);
  EXPECT_EQ(figures.iou_mean, std::nullopt);
}

TEST(EvaluateColumns, WithoutCameraHeightOnlyTheAngleIsNone) {
  SmallHome home = MakeSmallHome();
  for (TruthView& view : home.truth.views) view.camera_height_m = 0;
  const ColumnFigures figures = Judge(home);
  EXPECT_EQ(figures.error_median_deg, std::nullopt);
  EXPECT_EQ(figures.within_5pct, 1.0);
}

SmallHome MakeHomeWithBins() {
  SmallHome home = MakeSmallHome();
  home.structure.bin_m = DistanceBins{}.Centers();
  for (WallProfile& profile : home.structure.profiles) {
    profile.wall_probability =
        ImageF(profile.num_columns(), static_cast<int>(home.structure.bin_m.size()));
  }
  return home;
}

TEST(WithTrueProfiles, EveryColumnIsJudgedPerfectAndCertain) {
  SmallHome home = MakeHomeWithBins();
  for (WallProfile& profile : home.structure.profiles) {
    for (float& wall_m : profile.wall_m) wall_m *= 1.3F;
  }
  home.structure = WithTrueProfiles(home.scene, home.structure, home.truth, kMatches);
  EXPECT_NEAR(*Judge(home).error_median_m, 0, 1e-6);
  // A column may pass between the wall and the door, which stands in its middle.
  EXPECT_GE(*Judge(home).within_5pct, 0.99);
  for (const WallProfile& profile : home.structure.profiles) {
    for (int c = 0; c < profile.num_columns(); ++c) {
      const auto i = static_cast<size_t>(c);
      EXPECT_EQ(profile.confidence[i], 1);
      EXPECT_EQ(profile.obstacle_m[i], profile.wall_m[i]);
      const float* mass = profile.wall_probability.row(c);
      double sum = 0, mean_m = 0;
      for (size_t b = 0; b < home.structure.bin_m.size(); ++b) {
        sum += mass[b];
        mean_m += mass[b] * home.structure.bin_m[b];
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      EXPECT_NEAR(mean_m, profile.wall_m[i], 1e-4);
    }
  }
}

TEST(WithTrueProfiles, WithoutTruthNothingIsSeen) {
  const SmallHome home = MakeHomeWithBins();
  const Structure structure =
      WithTrueProfiles(home.scene, home.structure, home.truth, std::vector<int>{0, -1, 2});
  EXPECT_THAT(structure.profiles[1].is_seen, testing::Each(0));
  EXPECT_THAT(structure.profiles[0].is_seen, testing::Each(1));
}

TEST(FormatAblation, OneAlignedRowASetOfCues) {
  ColumnFigures figures;
  figures.error_median_deg = 0.58;
  figures.relative_error_median = 0.025;
  figures.error_median_m = 0.036;
  figures.within_5pct = 0.79;
  figures.within_10pct = 0.83;
  figures.iou_median = 0.778;
  const std::vector<AblationRow> rows = {{"floor edge", {}}, {"edges + correlation", figures}};
  EXPECT_EQ(
      FormatAblation(rows),
      "cues                 error °  relative %     cm  in 5 %  in 10 %  IoU median   mean\n"
      "floor edge               n/a         n/a    n/a     n/a      n/a         n/a    n/a\n"
      "edges + correlation     0.58         2.5    3.6      79       83       0.778    n/a\n");
}

}  // namespace
}  // namespace enfilade
