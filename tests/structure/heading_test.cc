// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "enfilade/geometry/angles.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

constexpr int kWidth = 512;
const Eigen::Vector3d kCamera(0.3, -0.2, 1.4);

// A room round the camera whatever the heading.
BoxRoom RoomAtHeading(double heading_deg) {
  BoxRoom room;
  room.min = {-1.7, -1.3};
  room.max = {2.2, 1.9};
  room.heading_rad = DegToRad(heading_deg);
  return room;
}

HeadingHistogram Votes(const LevelPanorama& panorama) { return VoteHeading(panorama, {}); }

double Sum(const HeadingHistogram& histogram) {
  return std::accumulate(histogram.begin(), histogram.end(), 0.0);
}

// Difference of two headings, degrees; headings a quarter turn apart are the same.
double HeadingErrorDeg(double heading_rad, double truth_deg) {
  return std::abs(RadToDeg(WrapQuarter(heading_rad - DegToRad(truth_deg))));
}

class HeadingOfRoom : public ::testing::TestWithParam<double> {};

TEST_P(HeadingOfRoom, IsFoundFromOnePanorama) {
  const LevelPanorama panorama = DrawPanorama(RoomAtHeading(GetParam()), kCamera, kWidth, 2.0);
  const double heading = HeadingOfHistogram(Votes(panorama), {});
  EXPECT_LT(HeadingErrorDeg(heading, GetParam()), 0.1) << RadToDeg(heading);
  EXPECT_GE(heading, -kPi / 4);
  EXPECT_LT(heading, kPi / 4);
}

INSTANTIATE_TEST_SUITE_P(Headings, HeadingOfRoom,
                         ::testing::Values(-40.0, -17.3, 0.0, 12.6, 31.25, 44.9, 45.0, 101.0));

TEST(VoteHeading, NothingToSeeGivesNoVotesAndHeadingZero) {
  LevelPanorama blank{kCamera, ImageU8(128, 256, 3, 180), ImageU8(128, 256, 1, 1)};
  EXPECT_EQ(Sum(Votes(blank)), 0);
  EXPECT_EQ(HeadingOfHistogram(Votes(blank), {}), 0);
  EXPECT_EQ(HeadingOfHistogram({}, {}), 0);
}

TEST(VoteHeading, UnseenPixelsDoNotVote) {
  LevelPanorama panorama = DrawPanorama(RoomAtHeading(10), kCamera, 256);
  panorama.is_seen = ImageU8(panorama.rows(), panorama.cols());
  EXPECT_EQ(Sum(Votes(panorama)), 0);
}

TEST(VoteHeading, UprightEdgesDoNotVote) {
  LevelPanorama stripes{kCamera, ImageU8(128, 256, 3), ImageU8(128, 256, 1, 1)};
  for (int r = 0; r < 128; ++r) {
    for (int c = 0; c < 256; ++c) {
      for (int k = 0; k < 3; ++k) stripes.rgb(r, c, k) = c / 16 % 2 == 0 ? 60 : 200;
    }
  }
  EXPECT_EQ(Sum(Votes(stripes)), 0);
}

TEST(VoteHeading, PooledVotesOutweighOnePanoramaThatErrs) {
  HeadingHistogram pooled = Votes(DrawPanorama(RoomAtHeading(20), kCamera, kWidth));
  for (const double dx : {-0.5, 0.0, 0.5}) {
    const HeadingHistogram more =
        Votes(DrawPanorama(RoomAtHeading(-8), kCamera + Eigen::Vector3d(dx, dx / 2, 0), kWidth));
    for (size_t b = 0; b < pooled.size(); ++b) pooled[b] += more[b];
  }
  EXPECT_LT(HeadingErrorDeg(HeadingOfHistogram(pooled, {}), -8), 0.1);
}

TEST(HeadingOfHistogram, PeakAcrossTheFoldIsOnePeak) {
  HeadingHistogram histogram(900, 1.0);
  histogram.front() = histogram.back() = 50;  // −44.95° and +44.95°
  histogram[450] = 70;                        // alone stronger than either
  EXPECT_LT(HeadingErrorDeg(HeadingOfHistogram(histogram, {}), 45), 0.01);
}

}  // namespace
}  // namespace enfilade
