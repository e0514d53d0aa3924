// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/landscape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

Vector3d Ray(double azimuth_deg, double elevation_deg) {
  const double azimuth = DegToRad(azimuth_deg), elevation = DegToRad(elevation_deg);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

// Far things seen by a, `apart_deg` from each other, and by b that is turned by 70°.
struct Matches {
  std::vector<Vector3d> a, b;
  void AddFar(int count, double apart_deg, double elevation_deg) {
    for (int i = 0; i < count; ++i) {
      a.push_back(Ray(170 + apart_deg * i, elevation_deg));
      b.push_back(RotationZ(DegToRad(-70)) * a.back());
    }
  }
  [[nodiscard]] std::vector<size_t> Kept() const { return WithoutLandscape(a, b); }
};

TEST(WithoutLandscape, DropsWhatATurnExplains) {
  Matches matches;
  matches.AddFar(6, 5, 2);
  EXPECT_TRUE(matches.Kept().empty());
}

TEST(WithoutLandscape, KeepsWhatHasParallax) {
  Matches matches;
  matches.AddFar(6, 5, 2);
  matches.a.push_back(Ray(180, 3));
  matches.b.push_back(Ray(180 - 70 + 4, 3));
  matches.a.push_back(Ray(180, 3));
  matches.b.push_back(Ray(180 - 70, 8));
  EXPECT_EQ(matches.Kept(), (std::vector<size_t>{6, 7}));
}

TEST(WithoutLandscape, KeepsAFewThatAgreeByChance) {
  Matches matches;
  matches.AddFar(4, 5, 2);
  EXPECT_EQ(matches.Kept().size(), 4U);
}

TEST(WithoutLandscape, KeepsOneObject) {
  Matches matches;
  matches.AddFar(6, 0.2, 2);
  EXPECT_EQ(matches.Kept().size(), 6U);
}

// A ceiling right above both is no landscape.
TEST(WithoutLandscape, KeepsWhatIsHigh) {
  Matches matches;
  matches.AddFar(6, 5, 40);
  EXPECT_EQ(matches.Kept().size(), 6U);
}

TEST(WithoutLandscape, OfNoMatchesIsNone) { EXPECT_TRUE(WithoutLandscape({}, {}).empty()); }

}  // namespace
}  // namespace enfilade
