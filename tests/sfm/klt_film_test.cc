// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/sfm/klt_tracker.h"
#include "tests/sfm/rendered_film.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

struct Shares {
  double right = 0;  // tracked and within a pixel of the truth, of what is in view
  double wrong = 0;  // tracked and not, of what is tracked and in view
};

// Over all pairs of neighbouring frames; every other frame times `gain`.
Shares TrackPairs(const RenderedFilm& film, const KltOptions& options, double gain,
                  double* worst_gain_error) {
  RunContext context;
  double num_visible = 0, num_right = 0, num_wrong = 0;
  for (int f = 0; f + 1 < static_cast<int>(film.frames.size()); ++f) {
    const ImageU8& next = film.frames[static_cast<size_t>(f + 1)].rgb;
    const GrayPyramid a(film.frames[static_cast<size_t>(f)].rgb, options.num_levels,
                        options.wraps_around, context),
        b(TimesGain(next, gain), options.num_levels, options.wraps_around, context);
    const std::vector<Vector2d> features = DetectFeatures(a, {}, options, context);
    const FrameTrack track = TrackFeatures(a, b, features, options, context);
    if (track.gain) {
      *worst_gain_error = std::max(*worst_gain_error, std::abs(*track.gain / gain - 1));
    }
    for (size_t i = 0; i < features.size(); ++i) {
      const auto truth = film.Follow(f, f + 1, features[i]);
      if (!truth) continue;
      ++num_visible;
      if (track.statuses[i] != TrackStatus::kTracked) continue;
      Vector2d error = track.positions_px[i] - *truth;
      if (options.wraps_around) error.x() = std::remainder(error.x(), film.camera.width);
      ++(error.norm() < 1 ? num_right : num_wrong);
    }
  }
  EXPECT_GT(num_visible, 100);
  return {num_right / num_visible, num_wrong / (num_right + num_wrong)};
}

void ExpectGainsHelp(const RenderedFilm& film, const KltOptions& base, const Shares& expected) {
  for (const double gain : {1.0, 0.9, 0.7}) {
    for (const KltGain model : {KltGain::kNone, KltGain::kFrame, KltGain::kFeature}) {
      KltOptions options = base;
      options.gain = model;
      double worst_gain_error = 0;
      const Shares shares = TrackPairs(film, options, gain, &worst_gain_error);
      if (model != KltGain::kNone || gain == 1) {
        EXPECT_GT(shares.right, expected.right) << gain;
        EXPECT_LT(shares.wrong, expected.wrong) << gain;
      } else if (gain == 0.7) {
        EXPECT_LT(shares.right, 0.5);  // what the gain is for
      }
      EXPECT_LT(worst_gain_error, 0.005) << gain;
    }
  }
}

TEST(TrackFeatures, FollowsARenderedFilmWhateverItsExposure) {
  ExpectGainsHelp(RenderFilm(5, 8, CameraModel::kPinhole), {}, {.right = 0.95, .wrong = 0.03});
}

TEST(TrackFeatures, FollowsRenderedPanoramas) {
  KltOptions options;
  options.wraps_around = true;
  // Below are glossy floors: what is tracked there are mirror images, which move on their own.
  options.skipped_rows_share = 0.33;
  ExpectGainsHelp(RenderFilm(5, 5, CameraModel::kEquirectangular), options,
                  {.right = 0.85, .wrong = 0.08});
}

}  // namespace
}  // namespace enfilade
