// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "enfilade/sfm/klt_tracker.h"
#include "tests/sfm/drawn_texture.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

double Distance(const Vector2d& a, const Vector2d& b, double period_px) {
  Vector2d apart = a - b;
  if (period_px > 0) apart.x() = std::remainder(apart.x(), period_px);
  return apart.norm();
}

// The smaller eigenvalue at a pixel, straight from its definition.
double ScoreAt(const ImageU8& image, int row, int col) {
  const auto grey = [&image](int r, int c) {
    return static_cast<double>(
        image(std::clamp(r, 0, image.rows() - 1), std::clamp(c, 0, image.cols() - 1)));
  };
  Eigen::Matrix2d tensor = Eigen::Matrix2d::Zero();
  for (int r = row - 2; r <= row + 2; ++r) {
    for (int c = col - 2; c <= col + 2; ++c) {
      const Vector2d g(0.5 * (grey(r, c + 1) - grey(r, c - 1)),
                       0.5 * (grey(r + 1, c) - grey(r - 1, c)));
      tensor += g * g.transpose() / 25;
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(tensor).eigenvalues()[0];
}

std::vector<Vector2d> Detect(const ImageU8& image, const KltOptions& options,
                             const std::vector<Vector2d>& existing = {}, int num_threads = 1) {
  RunContext context(num_threads);
  return DetectFeatures(GrayPyramid(image, 1, options.wraps_around, context), existing, options,
                        context);
}

TEST(DetectFeatures, EqualsTheBruteForceTwin) {
  KltOptions options;
  options.min_distance_px = 7;
  const ImageU8 image = DrawnTexture(1).Draw(70, 90);
  struct Peak {
    double score;
    Vector2d position;
  };
  std::vector<Peak> peaks;
  for (int r = 8; r < 62; ++r) {
    for (int c = 8; c < 82; ++c) {
      const double score = ScoreAt(image, r, c);
      bool is_peak = score >= options.min_eigenvalue;
      for (int i = 0; i < 9 && is_peak; ++i) {
        is_peak = i == 4 || ScoreAt(image, r + i / 3 - 1, c + i % 3 - 1) < score;
      }
      if (is_peak) peaks.push_back({score, {c + 0.5, r + 0.5}});
    }
  }
  std::sort(peaks.begin(), peaks.end(),
            [](const Peak& a, const Peak& b) { return a.score > b.score; });
  std::vector<Vector2d> expected;
  for (const Peak& peak : peaks) {
    if (std::all_of(expected.begin(), expected.end(), [&](const Vector2d& other) {
          return Distance(other, peak.position, 0) >= 7;
        })) {
      expected.push_back(peak.position);
    }
  }
  ASSERT_GT(expected.size(), 15u);
  EXPECT_EQ(Detect(image, options), expected);
}

TEST(DetectFeatures, KeepsItsDistanceAndFillsUpToTheMost) {
  KltOptions options;
  options.max_features = 30;
  options.min_distance_px = 9;
  const ImageU8 image = DrawnTexture(2, 200).Draw(100, 200);
  for (const bool wraps_around : {false, true}) {
    options.wraps_around = wraps_around;
    std::vector<Vector2d> features = Detect(image, options);
    ASSERT_EQ(features.size(), 30u);
    features.resize(12);
    const std::vector<Vector2d> more = Detect(image, options, features);
    EXPECT_EQ(more.size(), 18u);
    features.insert(features.end(), more.begin(), more.end());
    for (size_t i = 0; i < features.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        ASSERT_GE(Distance(features[i], features[j], wraps_around ? 200 : 0), 9);
      }
    }
    EXPECT_TRUE(Detect(image, options, features).empty());
  }
}

TEST(DetectFeatures, SkipsThePolesAndUsesTheSeam) {
  KltOptions options;
  options.wraps_around = true;
  options.skipped_rows_share = 0.25;
  const std::vector<Vector2d> features = Detect(DrawnTexture(3, 256).Draw(128, 256), options);
  int num_at_seam = 0;
  for (const Vector2d& feature : features) {
    EXPECT_GE(feature.y(), 32);
    EXPECT_LE(feature.y(), 96);
    num_at_seam += feature.x() < 6 || feature.x() > 250;
  }
  // 12 of 256 columns hold about that share of the features.
  EXPECT_NEAR(num_at_seam, 12.0 / 256 * static_cast<double>(features.size()), 4);
  EXPECT_GE(num_at_seam, 2);
}

TEST(DetectFeatures, FindsNothingInPicturesWithoutCorners) {
  KltOptions options;
  EXPECT_TRUE(Detect(ImageU8(), options).empty());
  EXPECT_TRUE(Detect(ImageU8(1, 1), options).empty());
  EXPECT_TRUE(Detect(ImageU8(5, 300, 1, 90), options).empty());
  EXPECT_TRUE(Detect(ImageU8(100, 100, 3, 200), options).empty());
  ImageU8 edge(60, 60);
  for (int r = 0; r < 60; ++r) std::fill_n(edge.row(r) + 30, 30, uint8_t{200});
  EXPECT_TRUE(Detect(edge, options).empty());
}

TEST(DetectFeatures, IsTheSameForAnyNumberOfThreads) {
  const ImageU8 image = DrawnTexture(4).Draw(150, 150);
  EXPECT_EQ(Detect(image, {}, {}, 1), Detect(image, {}, {}, 3));
}

}  // namespace
}  // namespace enfilade
