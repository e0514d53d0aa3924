// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/boolean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

MultiPolygon2 Region(const char* text) { return {{ParseRing(text), {}}}; }

MultiPolygon2 Rectangle(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}}};
}

MultiPolygon2 RandomRegion(std::mt19937& random) {
  std::uniform_real_distribution<double> corner(-4, 4), size(0.2, 4);
  MultiPolygon2 region;
  for (int i = 0; i < 4; ++i) {
    const double x = corner(random), y = corner(random);
    region.push_back(Rectangle(x, y, x + size(random), y + size(random))[0]);
  }
  return region;
}

void ExpectConventions(const MultiPolygon2& region) {
  for (const Polygon2& polygon : region) {
    EXPECT_GT(SignedArea(polygon.outer), 0);
    EXPECT_TRUE(IsSimple(polygon.outer)) << RingToText(polygon.outer);
    for (const Ring2& hole : polygon.holes) {
      EXPECT_LT(SignedArea(hole), 0);
      EXPECT_TRUE(IsSimple(hole)) << RingToText(hole);
    }
  }
}

TEST(Boolean, KnownRectangles) {
  const MultiPolygon2 a = Rectangle(0, 0, 4, 3), b = Rectangle(3, 1, 6, 2);
  EXPECT_DOUBLE_EQ(Area(Union(a, b)), 14);
  EXPECT_DOUBLE_EQ(Area(Intersection(a, b)), 1);
  EXPECT_DOUBLE_EQ(Area(Difference(a, b)), 11);
  EXPECT_DOUBLE_EQ(AreaIou(a, b), 1.0 / 14);
}

TEST(Boolean, HolesAppearAndAreClockwise) {
  const MultiPolygon2 ring = Difference(Rectangle(0, 0, 4, 4), Rectangle(1, 1, 2, 2));
  ASSERT_EQ(ring.size(), 1);
  ASSERT_EQ(ring[0].holes.size(), 1);
  ExpectConventions(ring);
  EXPECT_DOUBLE_EQ(Area(ring), 15);
  EXPECT_DOUBLE_EQ(Area(Union(ring, Rectangle(1, 1, 2, 2))), 16);
}

TEST(Boolean, EmptyAndDisjoint) {
  const MultiPolygon2 a = Rectangle(0, 0, 1, 1), b = Rectangle(5, 5, 6, 6), none;
  EXPECT_TRUE(Intersection(a, b).empty());
  EXPECT_TRUE(Intersection(a, none).empty());
  EXPECT_EQ(Union(a, b).size(), 2);
  EXPECT_DOUBLE_EQ(Area(Union(a, none)), 1);
  EXPECT_TRUE(Difference(a, a).empty());
  EXPECT_TRUE(Difference(none, a).empty());
  EXPECT_EQ(AreaIou(none, none), 1);
  EXPECT_EQ(AreaIou(a, none), 0);
}

TEST(Boolean, TouchingRectanglesShareNoArea) {
  const MultiPolygon2 a = Rectangle(0, 0, 1, 1), b = Rectangle(1, 0, 2, 1);
  EXPECT_TRUE(Intersection(a, b).empty());  // a line is no region
  EXPECT_EQ(Union(a, b).size(), 1);
  EXPECT_TRUE(Intersection(a, Rectangle(1, 1, 2, 2)).empty());  // a point
}

TEST(Boolean, LawsOnRandomRegions) {
  std::mt19937 random(7);
  for (int i = 0; i < 40; ++i) {
    const MultiPolygon2 a = Union(RandomRegion(random)), b = Union(RandomRegion(random));
    const MultiPolygon2 both = Intersection(a, b), either = Union(a, b);
    ExpectConventions(both);
    ExpectConventions(either);
    EXPECT_NEAR(Area(either) + Area(both), Area(a) + Area(b), 1e-9);
    EXPECT_NEAR(Area(Difference(a, b)) + Area(both), Area(a), 1e-9);
    EXPECT_NEAR(Area(Union(b, a)), Area(either), 1e-9);
    EXPECT_NEAR(AreaIou(a, b), AreaIou(b, a), 1e-12);
    EXPECT_NEAR(AreaIou(a, a), 1, 1e-12);
  }
}

TEST(Boolean, MakesInputsValid) {
  EXPECT_DOUBLE_EQ(Area(Union(Region("0,0 4,4 4,0 0,4"))), 8);           // bow tie: two triangles
  EXPECT_DOUBLE_EQ(Area(Union(Region("0,0 0,4 4,4 4,0"))), 16);          // clockwise
  EXPECT_DOUBLE_EQ(Area(Union(Region("0,0 4,0 4,4 4,4 0,4"))), 16);      // repeated vertex
  EXPECT_DOUBLE_EQ(Area(Union(Region("0,0 4,0 9,0 4,0 4,4 0,4"))), 16);  // spike
  EXPECT_TRUE(Union(Region("0,0 4,0 2,0")).empty());                     // no area
  EXPECT_TRUE(Union(Region("1,1 1,1 1,1")).empty());                     // a point
  EXPECT_TRUE(Union(Region("0,0 1,1")).empty());                         // too few vertices
  MultiPolygon2 overlapping = Rectangle(0, 0, 2, 2);
  overlapping.push_back(Rectangle(1, 0, 3, 2)[0]);
  EXPECT_DOUBLE_EQ(Area(Union(overlapping)), 6);
  EXPECT_DOUBLE_EQ(Area(Intersection(Region("0,0 4,4 4,0 0,4"), Rectangle(0, 0, 2, 4))), 4);
  // A hole that leaves the outer ring, and one that covers it.
  EXPECT_DOUBLE_EQ(Area(Union({{ParseRing("0,0 4,0 4,4 0,4"), {ParseRing("3,1 3,2 5,2 5,1")}}})),
                   15 + 1);
}

TEST(Boolean, NanIsABug) {
  const double nan = std::nan("");
  EXPECT_THROW((void)Union({{{{0, 0}, {1, nan}, {1, 1}}, {}}}), std::logic_error);
}

TEST(Offset, Squares) {
  const MultiPolygon2 square = Rectangle(0, 0, 4, 4);
  // Grown: the square, four strips and a disc, which a polygon of 128 corners stands for.
  EXPECT_NEAR(Area(Offset(square, 1)), 16 + 16 + kPi, 5e-4 * kPi);
  EXPECT_NEAR(Area(Offset(square, -1)), 4, 1e-12);
  EXPECT_TRUE(Offset(square, -2.5).empty());
  EXPECT_NEAR(Area(Offset(square, 0)), 16, 1e-12);
  EXPECT_TRUE(Offset({}, 1).empty());
  ExpectConventions(Offset(square, 1));
}

TEST(OffsetSharp, KeepsRightAnglesAndClosesWhatIsNarrow) {
  const MultiPolygon2 square = {{ParseRing("0,0 4,0 4,4 0,4"), {}}};
  const MultiPolygon2 wide = OffsetSharp(square, 1);
  EXPECT_NEAR(Area(wide), 36, 1e-12);
  EXPECT_EQ(wide[0].outer.size(), 4u);
  EXPECT_NEAR(Area(OffsetSharp(square, -1)), 4, 1e-12);
  EXPECT_TRUE(OffsetSharp(square, -2.5).empty());
  EXPECT_TRUE(OffsetSharp({}, 1).empty());
  ExpectConventions(wide);
  // A gap of 1 closes for good under 0.5, one of 2 does not.
  for (const double gap : {1.0, 2.0}) {
    const MultiPolygon2 two = {Polygon2{ParseRing("0,0 4,0 4,4 0,4"), {}},
                               Polygon2{{{0, 4 + gap}, {4, 4 + gap}, {4, 9}, {0, 9}}, {}}};
    const MultiPolygon2 closed = OffsetSharp(OffsetSharp(two, 0.51), -0.51);
    EXPECT_NEAR(Area(closed), Area(two) + (gap < 1.5 ? 4 * gap : 0), 1e-9);
  }
}

TEST(OffsetSharp, EdgesThatMissEachOtherByARoundingErrorDoNoHarm) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> tenth(0, 60), size(3, 30), ulps(-3, 3);
  const auto jitter = [&](double v) { return v + 1e-15 * ulps(random); };
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    MultiPolygon2 clean, noisy;
    for (int i = 0; i < 6; ++i) {
      const double x = 0.1 * tenth(random), y = 0.1 * tenth(random);
      const double w = 0.1 * size(random), h = 0.1 * size(random);
      clean.push_back({{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}});
      Ring2 ring = clean.back().outer;
      for (Eigen::Vector2d& p : ring) p = {jitter(p.x()), jitter(p.y())};
      noisy.push_back({ring, {}});
    }
    const MultiPolygon2 closed = OffsetSharp(OffsetSharp(noisy, 0.47), -0.47);
    const MultiPolygon2 rest = Difference(closed, noisy);
    const MultiPolygon2 opened = OffsetSharp(OffsetSharp(rest, -0.17), 0.17);
    EXPECT_NEAR(Area(closed), Area(OffsetSharp(OffsetSharp(clean, 0.47), -0.47)), 0.02);
    EXPECT_LE(Area(opened), Area(rest) + 1e-4);
  }
}

TEST(Offset, DiscsAndErrorOfTheArcs) {
  Ring2 disc;
  for (int i = 0; i < 256; ++i) {
    const double angle = 2 * kPi * i / 256;
    disc.push_back(2 * Vector2d(std::cos(angle), std::sin(angle)));
  }
  EXPECT_NEAR(Area(Offset({{disc, {}}}, 1)), 9 * kPi, 9 * kPi * 1e-3);
  EXPECT_NEAR(Area(Offset({{disc, {}}}, -1)), kPi, kPi * 1e-3);
  const MultiPolygon2 circle = Offset(Region("0,0 1e-3,0 0,1e-3"), 1);
  ASSERT_EQ(circle.size(), 1);
  for (const Vector2d& p : circle[0].outer) {
    EXPECT_NEAR(p.norm(), 1, 2e-3);
  }
}

TEST(Offset, GrowsMonotonically) {
  std::mt19937 random(8);
  for (int i = 0; i < 10; ++i) {
    const MultiPolygon2 region = Union(RandomRegion(random));
    EXPECT_NEAR(Area(Difference(region, Offset(region, 0.1))), 0, 1e-9);
    EXPECT_NEAR(Area(Difference(Offset(region, -0.1), region)), 0, 1e-9);
  }
}

TEST(CloseRegion, ClosesGapsOfWallsAndSmallHoles) {
  // Two rooms behind a wall of 10 cm, with a pillar of 0.25 m² and a courtyard of 2.25 m².
  MultiPolygon2 rooms = Difference(Rectangle(0, 0, 4, 4), Rectangle(1, 1, 1.5, 1.5));
  rooms.push_back(Difference(Rectangle(4.1, 0, 8, 4), Rectangle(5, 1, 6.5, 2.5))[0]);
  const MultiPolygon2 closed = CloseRegion(rooms, 0.3, 1.0);
  ASSERT_EQ(closed.size(), 1);
  ASSERT_EQ(closed[0].holes.size(), 1);
  // The disc rounds the four corners of the courtyard.
  EXPECT_NEAR(Area(closed), 8 * 4 - 2.25 + 0.3 * 0.3 * (4 - kPi), 1e-3);
  ExpectConventions(closed);
}

TEST(CloseRegion, ContainsTheRegion) {
  std::mt19937 random(9);
  for (int i = 0; i < 10; ++i) {
    const MultiPolygon2 region = Union(RandomRegion(random));
    EXPECT_LT(Area(Difference(region, CloseRegion(region, 0.3, 1))), 1e-3 * Area(region));
  }
}

TEST(CloseRegion, IslandInAFilledHoleCountsOnce) {
  MultiPolygon2 region = Difference(Rectangle(0, 0, 10, 10), Rectangle(4, 4, 6, 6));
  region.push_back(Rectangle(4.8, 4.8, 5.2, 5.2)[0]);
  EXPECT_NEAR(Area(CloseRegion(region, 0.1, 5)), 100, 1e-3);
}

}  // namespace
}  // namespace enfilade
