// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/klt_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "enfilade/base/errors.h"
#include "tests/sfm/drawn_texture.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kRows = 160, kCols = 200, kNumFrames = 8;
const Vector2d kShift(2.3, -1.1);

// Brightness of frame f over that of the first.
double Exposure(int f) { return 1 + 0.25 * std::sin(f); }

KltTracker TrackFilm(int num_threads = 1) {
  const DrawnTexture texture(1);
  KltOptions options;
  options.max_features = 120;
  KltTracker tracker(options);
  RunContext context(num_threads);
  for (int f = 0; f < kNumFrames; ++f) {
    tracker.AddFrame(texture.Draw(kRows, kCols, f * kShift, Exposure(f)), context);
  }
  return tracker;
}

TEST(KltTracker, FollowsAFilmAndItsExposure) {
  const KltTracker tracker = TrackFilm();
  ASSERT_EQ(tracker.frames().size(), static_cast<size_t>(kNumFrames));
  EXPECT_FALSE(tracker.frames()[0].gain);
  for (int f = 0; f < kNumFrames; ++f) {
    const TrackedFrame& frame = tracker.frames()[static_cast<size_t>(f)];
    EXPECT_NEAR(frame.exposure / Exposure(f), 1, 0.003) << f;
    EXPECT_GE(frame.points.size(), 100u);
    EXPECT_LE(frame.points.size(), 120u);
    for (size_t i = 1; i < frame.points.size(); ++i) {
      EXPECT_LT(frame.points[i - 1].track_id, frame.points[i].track_id);
    }
  }
}

TEST(KltTracker, TracksHoldTheMotionOverAllTheirFrames) {
  const KltTracker tracker = TrackFilm();
  const std::vector<FeatureTrack> tracks = tracker.Tracks();
  size_t num_points = 0, num_whole = 0;
  for (const FeatureTrack& track : tracks) {
    ASSERT_FALSE(track.positions_px.empty());
    num_points += track.positions_px.size();
    num_whole += track.positions_px.size() == kNumFrames;
    for (size_t i = 0; i < track.positions_px.size(); ++i) {
      const Vector2d expected = track.positions_px[0] + static_cast<double>(i) * kShift;
      EXPECT_LT((track.positions_px[i] - expected).norm(), 0.08 * static_cast<double>(i) + 1e-9);
    }
  }
  EXPECT_GE(num_whole, 70u);
  size_t num_expected = 0;
  for (const TrackedFrame& frame : tracker.frames()) {
    num_expected += frame.points.size();
    for (const TrackPoint& point : frame.points) {
      const FeatureTrack& track = tracks[static_cast<size_t>(point.track_id)];
      const size_t f = static_cast<size_t>(&frame - tracker.frames().data());
      EXPECT_EQ(track.positions_px[f - static_cast<size_t>(track.first_frame_idx)],
                point.position_px);
    }
  }
  EXPECT_EQ(num_points, num_expected);
}

TEST(KltTracker, StartsAnewAfterABlackFrame) {
  const ImageU8 image = DrawnTexture(2).Draw(kRows, kCols);
  RunContext context(1);
  KltTracker tracker({});
  const size_t num_first = tracker.AddFrame(image, context).points.size();
  EXPECT_TRUE(tracker.AddFrame(ImageU8(kRows, kCols), context).points.empty());
  const TrackedFrame& last = tracker.AddFrame(image, context);
  EXPECT_EQ(last.points.size(), num_first);
  EXPECT_EQ(last.points[0].track_id, static_cast<int>(num_first));
  EXPECT_FALSE(last.gain);
  EXPECT_EQ(last.exposure, 1);
}

TEST(KltTracker, IsTheSameForAnyNumberOfThreads) {
  const KltTracker one = TrackFilm(1), three = TrackFilm(3);
  for (size_t f = 0; f < kNumFrames; ++f) {
    const TrackedFrame &a = one.frames()[f], &b = three.frames()[f];
    EXPECT_EQ(a.exposure, b.exposure);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (size_t i = 0; i < a.points.size(); ++i) {
      EXPECT_EQ(a.points[i].track_id, b.points[i].track_id);
      EXPECT_EQ(a.points[i].position_px, b.points[i].position_px);
    }
  }
}

TEST(KltTracker, RefusesBadFramesAndOptions) {
  RunContext context(1);
  KltTracker tracker({});
  EXPECT_THROW(tracker.AddFrame(ImageU8(), context), InvalidInputError);
  EXPECT_THROW(tracker.AddFrame(ImageU8(20, 20, 2), context), InvalidInputError);
  tracker.AddFrame(ImageU8(20, 20), context);
  EXPECT_THROW(tracker.AddFrame(ImageU8(20, 21), context), InvalidInputError);
  EXPECT_EQ(tracker.frames().size(), 1u);
  for (const int window_px : {0, 7, 10, 28}) {
    KltOptions options;
    options.window_px = window_px;
    EXPECT_THROW(KltTracker{options}, InvalidInputError) << window_px;
  }
  KltOptions options;
  options.convergence_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(KltTracker{options}, InvalidInputError);
}

}  // namespace
}  // namespace enfilade
