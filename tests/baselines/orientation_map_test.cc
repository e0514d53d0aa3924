// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/orientation_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/scene/surface_label.h"

namespace enfilade {
namespace {

constexpr int kRows = 256, kCols = 512;

struct Seen {
  int axis = 0;  // of the surface's normal
  double u = 0;  // along the surface, metres
  SurfaceLabel label = SurfaceLabel::kWall;
};

// A room of 5 m × 4 m × 2.5 m, the camera at (2, 1.7, 1.4) from its lowest corner.
Seen Look(double azimuth, double elevation) {
  const double d[3] = {std::cos(elevation) * std::cos(azimuth),
                       std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  const double at[3] = {2, 1.7, 1.4}, size[3] = {5, 4, 2.5};
  double nearest = 1e9;
  Seen seen;
  for (int axis = 0; axis < 3; ++axis) {
    const double t = d[axis] > 0 ? (size[axis] - at[axis]) / d[axis] : -at[axis] / d[axis];
    if (t >= nearest) continue;
    nearest = t;
    seen.axis = axis;
    seen.u = at[axis == 0 ? 1 : 0] + t * d[axis == 0 ? 1 : 0];
  }
  if (seen.axis == 2) seen.label = d[2] > 0 ? SurfaceLabel::kCeiling : SurfaceLabel::kFloor;
  return seen;
}

template <typename Paint>
ImageU8 Draw(const Paint& paint) {
  ImageU8 rgb(kRows, kCols, 3);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      const Seen seen = Look(2 * kPi * (c + 0.5) / kCols - kPi, kPi * (0.5 - (r + 0.5) / kRows));
      for (int k = 0; k < 3; ++k) rgb(r, c, k) = static_cast<uint8_t>(paint(seen));
    }
  }
  return rgb;
}

int Brightness(const Seen& seen) {
  if (seen.label == SurfaceLabel::kFloor) return 60;
  if (seen.label == SurfaceLabel::kCeiling) return 240;
  return seen.axis == 0 ? 150 : 190;
}

TEST(MapOrientations, ABareRoomIsKnownNearlyEverywhere) {
  const OrientationMap map = MapOrientations(Draw(Brightness), {});
  int right = 0, wrong = 0;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      if (map.labels(r, c) == 0) continue;
      const Seen seen = Look(2 * kPi * (c + 0.5) / kCols - kPi, kPi * (0.5 - (r + 0.5) / kRows));
      (map.labels(r, c) == static_cast<uint8_t>(seen.label) &&
               map.orientation(r, c) == 1 + seen.axis
           ? right
           : wrong) += 1;
    }
  }
  EXPECT_GT(right, kRows * kCols * 85 / 100);
  EXPECT_LT(wrong, kRows * kCols * 3 / 100);
}

TEST(MapOrientations, LinesRunAlongTheEdgesOfTheRoom) {
  const OrientationMap map = MapOrientations(Draw(Brightness), {});
  std::array<int, 4> count{};
  for (const uint8_t line : map.lines.data()) ++count.at(line);
  // Four edges along each axis; upright ones have 100 to 200 rows each.
  for (size_t axis = 1; axis < 4; ++axis) EXPECT_GT(count.at(axis), 200) << axis;
  // The corner at the far end of both long walls: upright.
  const double corner = std::atan2(4 - 1.7, 5 - 2.0);
  const int col = static_cast<int>((corner + kPi) / (2 * kPi) * kCols);
  bool is_upright = false;
  for (int c = col - 1; c <= col + 1; ++c) is_upright = is_upright || map.lines(kRows / 2, c) == 3;
  EXPECT_TRUE(is_upright);
}

TEST(MapOrientations, WithoutLinesNothingIsKnown) {
  const OrientationMap map = MapOrientations(ImageU8(kRows, kCols, 3, 90), {});
  EXPECT_THAT(map.labels.data(), testing::Each(0));
  EXPECT_THAT(map.lines.data(), testing::Each(0));
}

TEST(MapOrientations, ShortLinesDoNotCount) {
  // A chequered wall: squares of 5 cm.
  const ImageU8 chequered = Draw([](const Seen& seen) {
    return seen.label == SurfaceLabel::kWall && static_cast<int>(seen.u / 0.05) % 2 == 0 ? 100
                                                                                         : 110;
  });
  OrientationMapOptions options;
  options.min_length_deg = 80;
  EXPECT_THAT(MapOrientations(chequered, options).lines.data(), testing::Each(testing::Ne(1)));
}

TEST(MapOrientations, LargerPicturesAreReduced) {
  OrientationMapOptions options;
  options.width = 128;
  const OrientationMap map = MapOrientations(Draw(Brightness), options);
  EXPECT_EQ(map.labels.cols(), 128);
  EXPECT_EQ(map.labels.rows(), 64);
}

}  // namespace
}  // namespace enfilade
