// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "enfilade/sfm/klt_tracker.h"
#include "tests/sfm/drawn_texture.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kRows = 200, kCols = 260;
constexpr KltGain kGains[] = {KltGain::kNone, KltGain::kFrame, KltGain::kFeature};

KltOptions WithGain(KltGain gain) {
  KltOptions options;
  options.gain = gain;
  options.min_eigenvalue = 20;
  return options;
}

struct Pair {
  std::vector<Vector2d> features;
  FrameTrack track;
};

Pair TrackPair(const ImageU8& first, const ImageU8& second, const KltOptions& options,
               int num_threads = 1) {
  RunContext context(num_threads);
  const GrayPyramid a(first, options.num_levels, options.wraps_around, context),
      b(second, options.num_levels, options.wraps_around, context);
  Pair pair;
  pair.features = DetectFeatures(a, {}, options, context);
  pair.track = TrackFeatures(a, b, pair.features, options, context);
  return pair;
}

// Greatest distance of tracked features from where the shift takes them.
double WorstError(const Pair& pair, const Vector2d& shift) {
  double worst = 0;
  for (size_t i = 0; i < pair.features.size(); ++i) {
    if (pair.track.statuses[i] != TrackStatus::kTracked) continue;
    worst = std::max(worst, (pair.track.positions_px[i] - pair.features[i] - shift).norm());
  }
  return worst;
}

double RmsError(const Pair& pair, const Vector2d& shift) {
  double sum = 0;
  for (size_t i = 0; i < pair.features.size(); ++i) {
    if (pair.track.statuses[i] != TrackStatus::kTracked) continue;
    sum += (pair.track.positions_px[i] - pair.features[i] - shift).squaredNorm();
  }
  return std::sqrt(sum / std::max(1, pair.track.NumTracked()));
}

// What is tracked of the features that stay in the picture.
double ShareTracked(const Pair& pair) {
  const auto num_out = std::count(pair.track.statuses.begin(), pair.track.statuses.end(),
                                  TrackStatus::kOutOfPicture);
  return pair.track.NumTracked() /
         (static_cast<double>(pair.features.size()) - static_cast<double>(num_out));
}

int Count(const FrameTrack& track, TrackStatus status) {
  return static_cast<int>(std::count(track.statuses.begin(), track.statuses.end(), status));
}

TEST(TrackFeatures, FollowsSubpixelShiftsWithAllModels) {
  const DrawnTexture texture(1);
  const ImageU8 first = texture.Draw(kRows, kCols);
  for (const Vector2d& shift :
       {Vector2d(0, 0), Vector2d(0.3, -0.7), Vector2d(-4.5, 2.25), Vector2d(11.8, 7.4)}) {
    const ImageU8 second = texture.Draw(kRows, kCols, shift);
    for (const KltGain gain : kGains) {
      const Pair pair = TrackPair(first, second, WithGain(gain));
      ASSERT_GT(pair.features.size(), 80u);
      EXPECT_GE(ShareTracked(pair), 0.96) << shift.transpose();
      // Interpolation smooths most half-way between pixels.
      EXPECT_LT(RmsError(pair, shift), shift.x() == -4.5 ? 0.04 : 0.02) << shift.transpose();
      EXPECT_LT(WorstError(pair, shift), 0.12) << shift.transpose();
    }
  }
}

// Between pixels, interpolation of the logarithms costs another tenth of a per cent.
TEST(TrackFeatures, RecoversGainsTogetherWithShifts) {
  const DrawnTexture texture(1);
  const ImageU8 first = texture.Draw(kRows, kCols);
  for (const double gain : {0.7, 0.9, 1.0, 1.1, 1.3}) {
    for (const Vector2d& shift : {Vector2d(3, -2), Vector2d(3.3, -1.6)}) {
      const double tolerance = (shift.x() == 3 ? 0.001 : 0.002) * gain;
      const ImageU8 second = texture.Draw(kRows, kCols, shift, gain);
      for (const KltGain model : {KltGain::kFrame, KltGain::kFeature}) {
        const Pair pair = TrackPair(first, second, WithGain(model));
        EXPECT_NEAR(*pair.track.gain, gain, tolerance);
        EXPECT_GE(ShareTracked(pair), 0.97);
        EXPECT_LT(RmsError(pair, shift), 0.025);
        double worst = 0;
        for (size_t i = 0; i < pair.features.size(); ++i) {
          if (pair.track.statuses[i] != TrackStatus::kTracked) continue;
          worst = std::max(worst, std::abs(pair.track.gains[i] - gain));
        }
        EXPECT_LT(worst, model == KltGain::kFrame ? tolerance : 0.01 * gain);
      }
    }
  }
}

TEST(TrackFeatures, PlainTrackingSaysNothingOfGains) {
  const ImageU8 image = DrawnTexture(2).Draw(kRows, kCols);
  const FrameTrack track = TrackPair(image, image, WithGain(KltGain::kNone)).track;
  EXPECT_FALSE(track.gain);
  for (const double gain : track.gains) EXPECT_EQ(gain, 1);
}

// Half of the picture gets darker: only a gain a feature can follow both halves.
TEST(TrackFeatures, GainsOfFeaturesDifferWhereTheLightDoes) {
  const DrawnTexture texture(3);
  const ImageU8 first = texture.Draw(kRows, kCols);
  ImageU8 second = texture.Draw(kRows, kCols, {1.5, 0.5});
  const ImageU8 dark = texture.Draw(kRows, kCols, {1.5, 0.5}, 0.8);
  for (int r = 0; r < kRows; ++r) std::copy_n(dark.row(r), kCols / 2, second.row(r));
  KltOptions options = WithGain(KltGain::kFeature);
  options.gain_stiffness = 0.05;
  const Pair pair = TrackPair(first, second, options);
  EXPECT_GT(pair.track.NumTracked(), 70);
  for (size_t i = 0; i < pair.features.size(); ++i) {
    const double to_edge = pair.features[i].x() - kCols / 2;
    if (pair.track.statuses[i] != TrackStatus::kTracked || std::abs(to_edge) < 12) continue;
    EXPECT_NEAR(pair.track.gains[i], to_edge < 0 ? 0.8 : 1.0, 0.04);
  }
}

TEST(TrackFeatures, StiffGainsOfFeaturesEqualThatOfTheFrame) {
  const DrawnTexture texture(4);
  const ImageU8 first = texture.Draw(kRows, kCols),
                second = texture.Draw(kRows, kCols, {2, 1}, 1.2);
  KltOptions stiff = WithGain(KltGain::kFeature);
  stiff.gain_stiffness = 1e6;
  const Pair frame = TrackPair(first, second, WithGain(KltGain::kFrame)),
             feature = TrackPair(first, second, stiff);
  ASSERT_EQ(frame.track.statuses, feature.track.statuses);
  for (size_t i = 0; i < frame.features.size(); ++i) {
    EXPECT_NEAR((frame.track.positions_px[i] - feature.track.positions_px[i]).norm(), 0, 1e-3);
    EXPECT_NEAR(frame.track.gains[i], feature.track.gains[i], 1e-4);
  }
}

// The brighter frame clips a good part of the picture, the darker one none.
TEST(TrackFeatures, ClippedPixelsDoNotSpoilTheGain) {
  const DrawnTexture texture(5);
  const ImageU8 dim = texture.Draw(kRows, kCols, {0, 0}, 1.4),
                bright = texture.Draw(kRows, kCols, {1.2, 0.4}, 2.1);
  const auto num_clipped = std::count(bright.data().begin(), bright.data().end(), 255);
  ASSERT_GT(num_clipped, kRows * kCols / 10);
  const Pair up = TrackPair(dim, bright, WithGain(KltGain::kFrame)),
             down = TrackPair(bright, dim, WithGain(KltGain::kFrame));
  EXPECT_NEAR(*up.track.gain, 1.5, 0.015);
  EXPECT_NEAR(*down.track.gain, 1 / 1.5, 0.01);
}

TEST(TrackFeatures, DarkFramesKeepTheirGain) {
  const DrawnTexture texture(6);
  const ImageU8 first = texture.Draw(kRows, kCols, {0, 0}, 0.3),
                second = texture.Draw(kRows, kCols, {0.2, 0.3}, 0.24);
  KltOptions options;
  options.min_eigenvalue = 1;
  const Pair pair = TrackPair(first, second, options);
  EXPECT_GT(pair.track.NumTracked(), 50);
  EXPECT_NEAR(*pair.track.gain, 0.8, 0.005);
  EXPECT_LT(RmsError(pair, {0.2, 0.3}), 0.05);
}

TEST(TrackFeatures, NoiseCostsLittle) {
  const DrawnTexture texture(1);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 2);
  const auto with_noise = [&](ImageU8 image) {
    for (uint8_t& value : image.data()) {
      value = static_cast<uint8_t>(std::clamp(std::lround(value + noise(random)), 0L, 255L));
    }
    return image;
  };
  const ImageU8 first = with_noise(texture.Draw(kRows, kCols)),
                second = with_noise(texture.Draw(kRows, kCols, {2.6, -3.1}, 0.85));
  const Pair pair = TrackPair(first, second, WithGain(KltGain::kFrame));
  EXPECT_GT(pair.track.NumTracked(), 50);
  EXPECT_NEAR(*pair.track.gain, 0.85, 0.002);
  EXPECT_LT(WorstError(pair, {2.6, -3.1}), 0.25);
}

// A turn takes the picture further than windows reach.
TEST(TrackFeatures, StartsFromTheShiftOfThePicture) {
  const DrawnTexture texture(1);
  const Vector2d shift(-71.3, 20.6);
  KltOptions options = WithGain(KltGain::kFrame);
  const Pair pair =
      TrackPair(texture.Draw(kRows, kCols), texture.Draw(kRows, kCols, shift, 1.2), options);
  const auto num_staying =
      std::count_if(pair.features.begin(), pair.features.end(), [&](const Vector2d& feature) {
        return feature.x() + shift.x() > 10 && feature.y() + shift.y() < kRows - 10;
      });
  EXPECT_GT(pair.track.NumTracked(), 0.9 * static_cast<double>(num_staying));
  EXPECT_LT(RmsError(pair, shift), 0.03);
  EXPECT_NEAR(*pair.track.gain, 1.2, 0.003);
  options.wraps_around = true;
  const DrawnTexture round(1, 256);
  const Pair turn = TrackPair(round.Draw(128, 256), round.Draw(128, 256, {100, 0}), options);
  EXPECT_GT(ShareTracked(turn), 0.95);
}

// A patch of another texture slides over the picture; what lay beneath is lost, and said to be.
TEST(TrackFeatures, RejectsWhatIsHidden) {
  const DrawnTexture texture(1), patch(9);
  const ImageU8 first = texture.Draw(kRows, kCols);
  ImageU8 second = texture.Draw(kRows, kCols, {1, 0});
  const ImageU8 cover = patch.Draw(kRows, kCols);
  for (int r = 50; r < 150; ++r) std::copy_n(cover.row(r) + 80, 100, second.row(r) + 80);
  for (const KltGain gain : kGains) {
    const Pair pair = TrackPair(first, second, WithGain(gain));
    int num_hidden = 0;
    for (size_t i = 0; i < pair.features.size(); ++i) {
      const Vector2d& at = pair.features[i];
      // The whole window is covered.
      if (at.x() < 86 || at.x() > 174 || at.y() < 56 || at.y() > 144) continue;
      ++num_hidden;
      EXPECT_TRUE(pair.track.statuses[i] == TrackStatus::kForwardBackward ||
                  pair.track.statuses[i] == TrackStatus::kResidual);
    }
    EXPECT_GT(num_hidden, 10);
  }
}

TEST(TrackFeatures, TracksAcrossTheSeamOfAPanorama) {
  const DrawnTexture texture(1, 256);
  const ImageU8 first = texture.Draw(128, 256), second = texture.Draw(128, 256, {-9.3, 0.4}, 1.1);
  for (const KltGain gain : {KltGain::kFrame, KltGain::kFeature}) {
    KltOptions options = WithGain(gain);
    options.wraps_around = true;
    const Pair pair = TrackPair(first, second, options);
    int num_crossed = 0;
    for (size_t i = 0; i < pair.features.size(); ++i) {
      if (pair.track.statuses[i] != TrackStatus::kTracked) continue;
      Vector2d error = pair.track.positions_px[i] - pair.features[i] - Vector2d(-9.3, 0.4);
      error.x() = std::remainder(error.x(), 256);
      EXPECT_LT(error.norm(), 0.06);
      EXPECT_GE(pair.track.positions_px[i].x(), 0);
      EXPECT_LE(pair.track.positions_px[i].x(), 256);
      num_crossed += pair.features[i].x() < 9;
    }
    EXPECT_GE(num_crossed, 2);
    EXPECT_EQ(
        Count(pair.track, TrackStatus::kTracked) + Count(pair.track, TrackStatus::kOutOfPicture),
        static_cast<int>(pair.features.size()));
  }
}

TEST(TrackFeatures, SaysWhyFeaturesAreLost) {
  RunContext context(1);
  const DrawnTexture texture(11);
  ImageU8 first = texture.Draw(kRows, kCols);
  for (int r = 80; r < 120; ++r) std::fill_n(first.row(r) + 100, 40, uint8_t{120});
  const KltOptions options;
  const GrayPyramid a(first, 4, false, context),
      moved(texture.Draw(kRows, kCols, {-8, 0}), 4, false, context),
      other(DrawnTexture(12).Draw(kRows, kCols), 4, false, context);
  const std::vector<Vector2d> features = {{120, 100}, {10, 100}, {2, 100}, {-5, 1e9}, {60, 60}};
  const FrameTrack track = TrackFeatures(a, moved, features, options, context);
  EXPECT_EQ(track.statuses[0], TrackStatus::kNoTexture);
  EXPECT_EQ(track.statuses[1], TrackStatus::kOutOfPicture);
  EXPECT_EQ(track.statuses[2], TrackStatus::kOutOfPicture);
  EXPECT_EQ(track.statuses[3], TrackStatus::kOutOfPicture);
  EXPECT_EQ(track.statuses[4], TrackStatus::kTracked);
  KltOptions strict;
  strict.max_residual = 1;
  EXPECT_EQ(TrackFeatures(a, other, features, strict, context).statuses[4], TrackStatus::kResidual);
}

TEST(TrackFeatures, BadPicturesGiveNoNumbersThatAreNone) {
  RunContext context(1);
  const ImageU8 texture = DrawnTexture(13).Draw(64, 64);
  for (const ImageU8& first : {texture, ImageU8(64, 64), ImageU8(64, 64, 1, 255)}) {
    for (const ImageU8& second : {texture, ImageU8(64, 64), ImageU8(64, 64, 1, 255)}) {
      for (const KltGain gain : kGains) {
        const KltOptions options = WithGain(gain);
        const GrayPyramid a(first, 4, false, context), b(second, 4, false, context);
        const std::vector<Vector2d> features = {{20, 20}, {40.3, 31.7}, {32, 32}};
        const FrameTrack track = TrackFeatures(a, b, features, options, context);
        EXPECT_TRUE(std::isfinite(track.gain.value_or(1)));
        for (size_t i = 0; i < features.size(); ++i) {
          EXPECT_TRUE(track.positions_px[i].allFinite());
          EXPECT_TRUE(std::isfinite(track.gains[i]));
          EXPECT_TRUE(std::isfinite(track.residuals[i]));
        }
      }
    }
  }
}

TEST(TrackFeatures, TakesEmptyAndTinyPictures) {
  RunContext context(1);
  for (const int side : {0, 1, 3, 15, 17}) {
    for (const bool wraps_around : {false, true}) {
      KltOptions options;
      options.wraps_around = wraps_around;
      const GrayPyramid pyramid(ImageU8(side, side, 1, 77), 4, wraps_around, context);
      const std::vector<Vector2d> features = {{0.5 * side, 0.5 * side}};
      const FrameTrack track = TrackFeatures(pyramid, pyramid, features, options, context);
      EXPECT_NE(track.statuses[0], TrackStatus::kTracked) << side;
      EXPECT_FALSE(track.gain);
    }
  }
}

TEST(TrackFeatures, IsTheSameForAnyNumberOfThreads) {
  const DrawnTexture texture(14);
  const ImageU8 first = texture.Draw(kRows, kCols),
                second = texture.Draw(kRows, kCols, {4, 2}, 1.2);
  for (const KltGain gain : kGains) {
    const FrameTrack one = TrackPair(first, second, WithGain(gain), 1).track,
                     three = TrackPair(first, second, WithGain(gain), 3).track;
    EXPECT_EQ(one.positions_px, three.positions_px);
    EXPECT_EQ(one.gains, three.gains);
    EXPECT_EQ(one.gain, three.gain);
    EXPECT_EQ(one.statuses, three.statuses);
  }
}

TEST(TrackFeatures, AllWindowsWork) {
  const DrawnTexture texture(15);
  const ImageU8 first = texture.Draw(kRows, kCols),
                second = texture.Draw(kRows, kCols, {3, -2}, 0.9);
  for (const int window_px : {8, 12, 16, 20, 24}) {
    KltOptions options;
    options.window_px = window_px;
    const Pair pair = TrackPair(first, second, options);
    EXPECT_LT(WorstError(pair, {3, -2}), 0.05) << window_px;
    EXPECT_NEAR(*pair.track.gain, 0.9, 0.001) << window_px;
  }
}

TEST(TrackFeatures, RefusesPositionsAndPyramidsThatCannotBe) {
  RunContext context(1);
  const KltOptions options;
  const GrayPyramid a(ImageU8(64, 64), 2, false, context), b(ImageU8(64, 60), 2, false, context);
  const std::vector<Vector2d> nowhere = {{std::numeric_limits<double>::quiet_NaN(), 3}};
  EXPECT_THROW((void)TrackFeatures(a, b, {}, options, context), std::logic_error);
  EXPECT_THROW((void)TrackFeatures(a, a, nowhere, options, context), std::logic_error);
}

}  // namespace
}  // namespace enfilade
