// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "enfilade/image/codec.h"
#include "enfilade/sfm/klt_tracker.h"
#include "tests/sfm/rendered_film.h"
#include "tests/support/real_data.h"

namespace enfilade {
namespace {

std::vector<ImageU8> RealFrames() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(RealDataFolder() / "hololens_office" / "images")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<ImageU8> frames;
  for (const auto& file : files) frames.push_back(ReadImageRgb(file));
  return frames;
}

// The camera turns by 7.7° from frame to frame in the median and by up to 25°, so that not every
// pair can be tracked; what the camera's own exposure does is measured on the frames as they are.
TEST(TrackFeatures, RecoversKnownGainsOnRealFrames) {
  ENFILADE_REQUIRE_REAL_DATA("hololens_office");
  const std::vector<ImageU8> frames = RealFrames();
  constexpr std::array kKnownGains = {1.03, 0.97, 1.1, 0.9, 0.7, 1.3};
  RunContext context;
  for (const KltGain model : {KltGain::kFrame, KltGain::kFeature}) {
    KltOptions options;
    options.gain = model;
    const auto pyramid = [&](const ImageU8& image) {
      return GrayPyramid(image, options.num_levels, false, context);
    };
    std::vector<double> errors;
    for (size_t f = 0; f + 1 < frames.size(); ++f) {
      // Both dimmed first, so that a gain of 1.3 clips nothing.
      const GrayPyramid first = pyramid(TimesGain(frames[f], 0.75)),
                        as_is = pyramid(TimesGain(frames[f + 1], 0.75));
      const double known = kKnownGains[f % kKnownGains.size()];
      const GrayPyramid changed = pyramid(TimesGain(frames[f + 1], 0.75 * known));
      const auto features = DetectFeatures(first, {}, options, context);
      const FrameTrack own = TrackFeatures(first, as_is, features, options, context),
                       track = TrackFeatures(first, changed, features, options, context);
      if (std::min(own.NumTracked(), track.NumTracked()) < 30) continue;
      errors.push_back(std::abs(*track.gain / *own.gain / known - 1));
    }
    ASSERT_GT(errors.size(), 60u);
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.005);
    EXPECT_LT(errors.back(), 0.02);
    RecordProperty("pairs", static_cast<int>(errors.size()));
    RecordProperty("median", std::to_string(errors[errors.size() / 2]));
    RecordProperty("worst", std::to_string(errors.back()));
  }
}

// Without motion nothing but the gain is left to find.
TEST(TrackFeatures, RecoversKnownGainsOfOneRealFrame) {
  ENFILADE_REQUIRE_REAL_DATA("hololens_office");
  RunContext context;
  const KltOptions options;
  const std::vector<ImageU8> frames = RealFrames();
  for (size_t f = 0; f < frames.size(); f += 8) {
    for (const double known : {0.7, 0.9, 0.97, 1.03, 1.1, 1.3}) {
      const GrayPyramid first(TimesGain(frames[f], 0.75), options.num_levels, false, context),
          second(TimesGain(frames[f], 0.75 * known), options.num_levels, false, context);
      const auto features = DetectFeatures(first, {}, options, context);
      const FrameTrack track = TrackFeatures(first, second, features, options, context);
      EXPECT_NEAR(*track.gain, known, 0.002 * known);
      EXPECT_GT(track.NumTracked(), 0.8 * static_cast<double>(features.size()));
    }
  }
}

}  // namespace
}  // namespace enfilade
