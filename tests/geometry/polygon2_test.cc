// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/polygon2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

const char kSquare[] = "0,0 4,0 4,4 0,4";
const char kLShape[] = "0,0 4,0 4,2 2,2 2,4 0,4";

Ring2 Reversed(Ring2 ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring2 Moved(Ring2 ring, double rad, const Vector2d& shift) {
  Eigen::Matrix2d rotation;
  rotation << std::cos(rad), -std::sin(rad), std::sin(rad), std::cos(rad);
  for (Vector2d& p : ring) p = rotation * p + shift;
  return ring;
}

// A star-shaped ring with `num_vertices` vertices.
Ring2 RandomRing(std::mt19937& random, int num_vertices) {
  std::uniform_real_distribution<double> radius(0.5, 3.0);
  Ring2 ring;
  for (int i = 0; i < num_vertices; ++i) {
    const double angle = 2 * kPi * i / num_vertices;
    ring.push_back(radius(random) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

TEST(SignedArea, KnownRings) {
  EXPECT_DOUBLE_EQ(SignedArea(ParseRing(kSquare)), 16);
  EXPECT_DOUBLE_EQ(SignedArea(Reversed(ParseRing(kSquare))), -16);
  EXPECT_DOUBLE_EQ(SignedArea(ParseRing(kLShape)), 12);
  EXPECT_EQ(SignedArea({}), 0);
  EXPECT_EQ(SignedArea(ParseRing("1,1")), 0);
  EXPECT_EQ(SignedArea(ParseRing("1,1 2,2")), 0);
}

TEST(SignedArea, InvariantUnderMotionAndStart) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    Ring2 ring = RandomRing(random, 9);
    const double area = SignedArea(ring);
    EXPECT_NEAR(SignedArea(Moved(ring, 0.3 * i, {5, -7})), area, 1e-12);
    std::rotate(ring.begin(), ring.begin() + 4, ring.end());
    EXPECT_NEAR(SignedArea(ring), area, 1e-12);
    EXPECT_NEAR(SignedArea(Reversed(ring)), -area, 1e-12);
  }
}

TEST(SignedArea, FarFromTheOrigin) {
  // UTM coordinates must not cost the digits of a square metre.
  EXPECT_NEAR(SignedArea(Moved(ParseRing(kSquare), 0, {5e5, 5e6})), 16, 1e-8);
}

TEST(Area, SubtractsHolesOfEitherOrientation) {
  const Ring2 hole = ParseRing("1,1 1,2 2,2 2,1");
  EXPECT_DOUBLE_EQ(Area(Polygon2{ParseRing(kSquare), {hole}}), 15);
  EXPECT_DOUBLE_EQ(Area(Polygon2{ParseRing(kSquare), {Reversed(hole)}}), 15);
  EXPECT_DOUBLE_EQ(
      Area(MultiPolygon2{{ParseRing(kSquare), {hole}}, {ParseRing("9,9 10,9 10,10"), {}}}), 15.5);
  EXPECT_EQ(Area(MultiPolygon2{}), 0);
}

TEST(Perimeter, KnownRings) {
  EXPECT_DOUBLE_EQ(Perimeter(ParseRing(kLShape)), 16);
  EXPECT_EQ(Perimeter({}), 0);
}

TEST(Contains, InsideOutsideAndHole) {
  const Polygon2 polygon{ParseRing(kSquare), {ParseRing("1,1 1,2 2,2 2,1")}};
  EXPECT_TRUE(Contains(polygon, {3, 3}));
  EXPECT_FALSE(Contains(polygon, {1.5, 1.5}));
  EXPECT_FALSE(Contains(polygon, {5, 3}));
  EXPECT_TRUE(Contains(ParseRing(kLShape), {1, 2}));  // level with a vertex
  EXPECT_FALSE(Contains(ParseRing(kLShape), {3, 3}));
  EXPECT_FALSE(Contains(Ring2{}, {0, 0}));
}

TEST(Contains, SplitsTheAreaOfRandomRings) {
  // Monte Carlo: the share of a box inside equals the area's share, within 4 standard deviations.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  const Ring2 ring = RandomRing(random, 15);
  const int num_samples = 20000;
  int num_inside = 0;
  for (int i = 0; i < num_samples; ++i) {
    const double x = coordinate(random);
    num_inside += Contains(ring, {x, coordinate(random)});
  }
  const double share = SignedArea(ring) / 36;
  EXPECT_NEAR(static_cast<double>(num_inside) / num_samples, share,
              4 * std::sqrt(share * (1 - share) / num_samples));
}

TEST(DistanceToRing, InsideAndOutside) {
  const Ring2 square = ParseRing("0,0 4,0 4,4 0,4");
  EXPECT_DOUBLE_EQ(DistanceToRing(square, {1, 2}), 1);
  EXPECT_DOUBLE_EQ(DistanceToRing(square, {7, 8}), 5);
  EXPECT_DOUBLE_EQ(DistanceToRing(square, {4, 2}), 0);
}

TEST(RingsOf, OuterRingThenHoles) {
  const Polygon2 polygon{ParseRing("0,0 4,0 4,4 0,4"), {ParseRing("1,1 1,2 2,2 2,1")}};
  const std::vector<Ring2> rings = RingsOf(polygon);
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[0], polygon.outer);
  EXPECT_EQ(rings[1], polygon.holes[0]);
}

TEST(DistanceToSegment, BeforeAlongAndAfter) {
  EXPECT_DOUBLE_EQ(DistanceToSegment({-3, 4}, {0, 0}, {2, 0}), 5);
  EXPECT_DOUBLE_EQ(DistanceToSegment({1, -2}, {0, 0}, {2, 0}), 2);
  EXPECT_DOUBLE_EQ(DistanceToSegment({5, 4}, {0, 0}, {2, 0}), 5);
  EXPECT_DOUBLE_EQ(DistanceToSegment({3, 4}, {0, 0}, {0, 0}), 5);  // a point
}

TEST(RayDistance, KnownWalls) {
  const Ring2 ring = ParseRing(kLShape);
  EXPECT_DOUBLE_EQ(RayDistance(ring, {1, 1}, {1, 0}), 3);
  EXPECT_DOUBLE_EQ(RayDistance(ring, {1, 3}, {1, 0}), 1);
  EXPECT_DOUBLE_EQ(RayDistance(ring, {1, 1}, {0, -1}), 1);
  EXPECT_DOUBLE_EQ(RayDistance(ring, {-2, 1}, {1, 0}), 2);  // from outside
  EXPECT_EQ(RayDistance(ring, {-2, 1}, {-1, 0}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(RayDistance({}, {0, 0}, {1, 0}), std::numeric_limits<double>::infinity());
}

TEST(RayDistance, RaysIntoCornersDoNotLeak) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Ring2 ring = Moved(ParseRing(kSquare), 0.1 * i, {0.3 * i, 1e3});
    const Vector2d center = 0.25 * (ring[0] + ring[1] + ring[2] + ring[3]);
    for (const Vector2d& corner : ring) {
      EXPECT_NEAR(RayDistance(ring, center, (corner - center).normalized()), std::sqrt(8.0), 1e-9);
    }
  }
}

TEST(RayDistance, EqualsMarchingAlongTheRay) {
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const Ring2 ring = RandomRing(random, 12);
    for (int k = 0; k < 20; ++k) {
      const double angle = 0.1 + 0.3 * k;
      const Vector2d direction(std::cos(angle), std::sin(angle));
      const double step = 1e-3;
      double marched = 0;
      while (Contains(ring, Vector2d(marched * direction))) marched += step;
      EXPECT_NEAR(RayDistance(ring, {0, 0}, direction), marched, 2 * step);
    }
  }
}

TEST(RemoveCollinear, KnownRings) {
  EXPECT_EQ(RingToText(RemoveCollinear(ParseRing("0,0 2,0 4,0 4,4 4,4 0,4 0,1"))),
            "0,0 4,0 4,4 0,4");
  // The first vertex may go, too.
  EXPECT_EQ(RemoveCollinear(ParseRing("2,0 4,0 4,4 0,4 0,0")).size(), 4);
  EXPECT_EQ(RingToText(RemoveCollinear(ParseRing("0,0 2,0.01 4,0 4,4 0,4"), 0.02)), kSquare);
  EXPECT_EQ(RemoveCollinear(ParseRing("0,0 2,0.01 4,0 4,4 0,4"), 0.005).size(), 5);
  EXPECT_EQ(RemoveCollinear({}).size(), 0);
  EXPECT_EQ(RemoveCollinear(ParseRing("0,0 1,0 2,0 3,0")).size(), 2);
}

TEST(RemoveCollinear, UndoesAddedVertices) {
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {
    const Ring2 ring = RandomRing(random, 10);
    Ring2 dense;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vector2d& next = ring[(k + 1) % ring.size()];
      for (const double t : {0.0, 0.25, 0.25, 0.7}) dense.push_back((1 - t) * ring[k] + t * next);
    }
    EXPECT_EQ(RemoveCollinear(dense), ring);
  }
}

TEST(IsSimple, Cases) {
  EXPECT_TRUE(IsSimple(ParseRing(kSquare)));
  EXPECT_TRUE(IsSimple(Reversed(ParseRing(kLShape))));
  EXPECT_TRUE(IsSimple(ParseRing("0,0 2,0 4,0 4,4 0,4")));       // straight on is no fold
  EXPECT_FALSE(IsSimple(ParseRing("0,0 4,4 4,0 0,4")));          // bow tie
  EXPECT_FALSE(IsSimple(ParseRing("0,0 4,0 2,0 2,4")));          // folds back
  EXPECT_FALSE(IsSimple(ParseRing("0,0 4,0 4,4 4,4 0,4")));      // repeats a vertex
  EXPECT_FALSE(IsSimple(ParseRing("0,0 4,0 4,4 2,0 0,4")));      // touches an edge
  EXPECT_FALSE(IsSimple(ParseRing("0,0 2,2 4,0 4,4 2,2 0,4")));  // touches a vertex
  EXPECT_FALSE(IsSimple(ParseRing("0,0 1,1")));
  EXPECT_FALSE(IsSimple({}));
}

TEST(RingText, RoundTripsToTheLastBit) {
  std::mt19937 random(6);
  const Ring2 ring = RandomRing(random, 8);
  EXPECT_EQ(ParseRing(RingToText(ring)), ring);
  EXPECT_EQ(RingToText(ParseRing(kLShape)), kLShape);
  EXPECT_TRUE(ParseRing("").empty());
}

TEST(RingText, MalformedTextIsABug) {
  for (const char* text : {"1", "1,", ",1", "1,2,3", "1,x", "1.5m,2", "1e999,0"}) {
    EXPECT_THROW((void)ParseRing(text), std::logic_error) << text;
  }
}

}  // namespace
}  // namespace enfilade
