// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/classify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"
#include "src/structure/label_view.h"

namespace enfilade {
namespace {

constexpr int kRows = 256, kCols = 512;
constexpr double kFloor_m = 1.4, kCeiling_m = 1.1;

using Colour = std::array<int, 3>;
constexpr Colour kCarpet = {120, 100, 80}, kPaint = {205, 205, 200}, kPlaster = {225, 225, 228};

// Distance of the wall of a room of 5 m × 4 m with the camera at (0.5, −0.3) from its middle.
double WallDistance(double azimuth) {
  const double x = std::cos(azimuth), y = std::sin(azimuth);
  const double to_x = x > 0 ? 2.0 / x : x < 0 ? -3.0 / x : 1e9;
  const double to_y = y > 0 ? 2.3 / y : y < 0 ? -1.7 / y : 1e9;
  return std::min(to_x, to_y);
}

SurfaceLabel TrueLabel(int row, int col) {
  const double z =
      WallDistance(AzimuthOfColumn(col, kCols)) * std::tan(kPi * (0.5 - (row + 0.5) / kRows));
  if (z < -kFloor_m) return SurfaceLabel::kFloor;
  return z > kCeiling_m ? SurfaceLabel::kCeiling : SurfaceLabel::kWall;
}

// The room with noise of a few grey levels; `paint` may change pixels.
ClassifyView MakeRoom(const std::function<void(int, int, Colour&)>& paint = {},
                      const ClassifyOptions& options = {}) {
  std::mt19937 random(3);
  ImageU8 rgb(kRows, kCols, 3);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      const SurfaceLabel label = TrueLabel(r, c);
      Colour colour = label == SurfaceLabel::kFloor  ? kCarpet
                      : label == SurfaceLabel::kWall ? kPaint
                                                     : kPlaster;
      if (paint) paint(r, c, colour);
      for (int k = 0; k < 3; ++k) {
        const int noise = static_cast<int>(random() % 7) - 3;
        rgb(r, c, k) =
            static_cast<uint8_t>(std::clamp(colour[static_cast<size_t>(k)] + noise, 0, 255));
      }
    }
  }
  ClassifyView view;
  view.superpixels = MakeSuperpixels(rgb, options.superpixels);
  view.floor_m = kFloor_m;
  view.ceiling_m = kCeiling_m;
  for (int c = 0; c < kCols; ++c)
    view.clear_m.push_back(0.85 * WallDistance(AzimuthOfColumn(c, kCols)));
  return view;
}

Classification Classify(const ClassifyView& view, const ClassifyOptions& options = {},
                        int num_threads = 2) {
  RunContext context(num_threads);
  return ClassifyPanoramas({view}, options, context).front();
}

double Accuracy(const ImageU8& map) {
  int right = 0;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) right += map(r, c) == static_cast<uint8_t>(TrueLabel(r, c));
  }
  return right / static_cast<double>(kRows * kCols);
}

// Of the pixels with a label.
double WrongShare(const ImageU8& map) {
  int wrong = 0, known = 0;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      if (map(r, c) == 0) continue;
      ++known;
      wrong += map(r, c) != static_cast<uint8_t>(TrueLabel(r, c));
    }
  }
  return wrong / std::max(1.0, static_cast<double>(known));
}

TEST(ClassifyPanoramas, SeedsAreRightAndAllElseFollows) {
  const Classification found = Classify(MakeRoom());
  EXPECT_THAT(found.maps.after_points.data(), testing::Each(0));
  EXPECT_LT(WrongShare(found.maps.after_free_space), 0.01);
  EXPECT_GT(Accuracy(found.maps.after_free_space), 0.3);
  EXPECT_GT(Accuracy(found.maps.final_labels), 0.98);
  EXPECT_THAT(found.maps.final_labels.data(), testing::Each(testing::Gt(0)));
  EXPECT_EQ(found.num_point_seeds, 0);
  EXPECT_GT(found.num_free_seeds, 100);
  EXPECT_LE(found.energy, found.seed_energy);
  EXPECT_EQ(found.costs.size(), static_cast<size_t>(found.num_superpixels));
}

TEST(ClassifyPanoramas, PointsAloneAreEnough) {
  ClassifyView view = MakeRoom();
  view.clear_m.clear();
  std::mt19937 random(11);
  for (int i = 0; i < 60000; ++i) {
    const int row = static_cast<int>(random() % kRows), col = static_cast<int>(random() % kCols);
    if (col > kCols / 2) continue;  // half of the room has none
    const double elevation = kPi * (0.5 - (row + 0.5) / kRows),
                 azimuth = AzimuthOfColumn(col, kCols);
    view.points.push_back({{static_cast<float>(std::cos(elevation) * std::cos(azimuth)),
                            static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                            static_cast<float>(std::sin(elevation))},
                           TrueLabel(row, col)});
  }
  const Classification found = Classify(view);
  EXPECT_GT(found.num_point_seeds, 500);
  EXPECT_LT(WrongShare(found.maps.after_points), 0.03);
  EXPECT_GT(Accuracy(found.maps.final_labels), 0.93);
}

// A room of one colour, where free space ends well before the walls, behind furniture.
TEST(ClassifyPanoramas, KnownWallsTellWhatColoursDoNot) {
  ClassifyView view = MakeRoom([](int, int, Colour& colour) { colour = kPaint; });
  for (double& clear_m : view.clear_m) clear_m *= 0.5;
  const double without = Accuracy(Classify(view).maps.final_labels);
  for (int c = 0; c < kCols; ++c) view.wall_m.push_back(WallDistance(AzimuthOfColumn(c, kCols)));
  const Classification found = Classify(view);
  EXPECT_GT(Accuracy(found.maps.final_labels), 0.95);
  EXPECT_LT(without, Accuracy(found.maps.final_labels) - 0.05);
  // What free space bounds stays as it is.
  EXPECT_LT(WrongShare(found.maps.after_free_space), 0.01);
}

TEST(ClassifyPanoramas, AFewPointsMakeNoSeed) {
  ClassifyView view = MakeRoom();
  view.points.assign(4, {{1, 0, 0}, SurfaceLabel::kCeiling});
  EXPECT_EQ(Classify(view).num_point_seeds, 0);
  view.points.assign(5, {{1, 0, 0}, SurfaceLabel::kCeiling});
  EXPECT_EQ(Classify(view).num_point_seeds, 1);
  view.points.insert(view.points.end(), 5, {{1, 0, 0}, SurfaceLabel::kWall});
  EXPECT_EQ(Classify(view).num_point_seeds, 0);  // none has most
  view.points.assign(9, {{1, 0, 0}, SurfaceLabel::kOther});
  EXPECT_EQ(Classify(view).num_point_seeds, 0);
}

TEST(ClassifyPanoramas, FreeSpaceOverrulesPointsAndSaysSo) {
  ClassifyView view = MakeRoom();
  view.points.assign(8, {{0, 0, -1}, SurfaceLabel::kWall});
  const Classification found = Classify(view);
  EXPECT_EQ(found.num_contradictions, 1);
  EXPECT_EQ(found.maps.after_points(kRows - 1, kCols / 2),
            static_cast<uint8_t>(SurfaceLabel::kWall));
  EXPECT_EQ(found.maps.after_free_space(kRows - 1, kCols / 2),
            static_cast<uint8_t>(SurfaceLabel::kFloor));
}

// A chest of drawers before the wall covers its foot: what stands before free space's end is floor,
// what covers the wall is wall.
TEST(ClassifyPanoramas, ClutterHasTheLabelOfWhatIsBehindIt) {
  const auto chest = [](int r, int c, Colour& colour) {
    if (c > 100 && c < 150 && r > 120 && r < 190) colour = {90, 40, 30};
  };
  EXPECT_GT(Accuracy(Classify(MakeRoom(chest)).maps.final_labels), 0.96);
}

TEST(ClassifyPanoramas, AFloorWithoutSeedsIsStillBelowTheWall) {
  ClassifyView view = MakeRoom();
  view.clear_m.clear();
  const Classification found = Classify(view);
  EXPECT_EQ(found.maps.final_labels(kRows / 2, 7), static_cast<uint8_t>(SurfaceLabel::kWall));
  for (int c = 0; c < kCols; c += 8) {
    for (int r = 1; r < kRows; ++r) {
      const auto rank = [&](int row) {
        const auto label = static_cast<SurfaceLabel>(found.maps.final_labels(row, c));
        return label == SurfaceLabel::kCeiling ? 2 : label == SurfaceLabel::kWall ? 1 : 0;
      };
      EXPECT_LE(rank(r), rank(r - 1) + 1);
    }
  }
}

TEST(ClassifyPanoramas, SameForAnyNumberOfThreads) {
  RunContext one(1), three(3);
  const std::vector<ClassifyView> views = {MakeRoom(), MakeRoom([](int, int c, Colour& colour) {
                                             if (c > 300) colour[0] -= 30;
                                           })};
  const auto a = ClassifyPanoramas(views, {}, one), b = ClassifyPanoramas(views, {}, three);
  for (size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(a[i].maps.final_labels.data(), b[i].maps.final_labels.data());
    EXPECT_EQ(a[i].costs, b[i].costs);
  }
  EXPECT_TRUE(ClassifyPanoramas({}, {}, one).empty());
}

TEST(ScoreLabels, PeakAtTheWall) {
  const ClassifyView view = MakeRoom();
  const DistanceBins bins;
  const ColumnScores scores = ScoreLabels(view, Classify(view), 128, bins, 10);
  int near = 0;
  for (int c = 0; c < 128; ++c) {
    const float* row = scores.family[0].row(c);
    const auto best = static_cast<int>(std::max_element(row, row + bins.count) - row);
    EXPECT_EQ(row[best], 0);
    near += std::abs(bins.Distance(best) / WallDistance(AzimuthOfColumn(c, 128)) - 1) < 0.05;
  }
  EXPECT_GT(near, 110);
  EXPECT_EQ(scores.family[kFrontalFamily].data(), scores.family[0].data());
  const ColumnScores capped = ScoreLabels(view, Classify(view), 128, bins, 0.01);
  EXPECT_GE(*std::min_element(capped.family[0].data().begin(), capped.family[0].data().end()),
            -0.0101F);
}

TEST(MapsInCamera, AreWhatTheCameraSaw) {
  const LabelMaps level = Classify(MakeRoom()).maps;
  // Upright, looking along +x of the home: x right is −y, y down is −z, z forward is x.
  Eigen::Matrix3d home_from_cam;
  home_from_cam << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const LabelMaps seen = MapsInCamera(level, home_from_cam);
  EXPECT_EQ(seen.final_labels(0, 5), static_cast<uint8_t>(SurfaceLabel::kCeiling));
  EXPECT_EQ(seen.final_labels(kRows - 1, 5), static_cast<uint8_t>(SurfaceLabel::kFloor));
  // Level panoramas run counter-clockwise, pictures clockwise; both have +x in the middle.
  int differing = 0;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c)
      differing += seen.final_labels(r, c) != level.final_labels(r, kCols - 1 - c);
  }
  EXPECT_LE(differing, kRows * kCols / 500);
}

TEST(ClearDistances, EndWhereCoreDoes) {
  EvidenceGrids evidence;
  evidence.frame = {{-1, -1}, 0.1, 30, 40};
  evidence.core = CoreImage(30, 40);
  for (int r = 5; r < 25; ++r) {
    for (int c = 5; c < 35; ++c) evidence.core(r, c) = 1;  // x −0.5 … 2.5, y −0.5 … 1.5
  }
  const std::vector<double> clear_m = ClearDistances(evidence, {0.5, 0.5}, 4);
  // Azimuths −135°, −45°, 45°, 135°: to the corners of a square of 1 m.
  EXPECT_THAT(clear_m, testing::Each(testing::DoubleNear(std::sqrt(2.0), 0.06)));
  EXPECT_THAT(ClearDistances(evidence, {-0.8, 0.5}, 4), testing::Each(0));
  EXPECT_THAT(ClearDistances(evidence, {90, 0.5}, 4), testing::Each(0));
}

}  // namespace
}  // namespace enfilade
