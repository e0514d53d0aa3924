// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

double TriangleArea(const Triangulation2& t, const std::array<int, 3>& triangle) {
  const auto vertex = [&](int k) {
    return t.vertices[static_cast<size_t>(triangle[static_cast<size_t>(k)])];
  };
  return SignedArea({vertex(0), vertex(1), vertex(2)});
}

// Triangles are counter-clockwise and cover the area; inner edges are used once in each direction,
// ring edges once, in the ring's own direction, and no other edge is open.
void ExpectCovers(const Polygon2& polygon) {
  const Triangulation2 t = Triangulate(polygon);
  double area = 0;
  std::map<std::pair<int, int>, int> num_uses;
  for (const auto& triangle : t.triangles) {
    EXPECT_GT(TriangleArea(t, triangle), 0);
    area += TriangleArea(t, triangle);
    for (size_t k = 0; k < 3; ++k) ++num_uses[{triangle[k], triangle[(k + 1) % 3]}];
  }
  EXPECT_NEAR(area, Area(polygon), 1e-12 * (1 + Area(polygon)));

  std::map<std::pair<int, int>, int> open;
  for (const auto& [edge, count] : num_uses) {
    EXPECT_EQ(count, 1);
    if (num_uses.count({edge.second, edge.first}) == 0) open[edge] = count;
  }
  std::map<std::pair<int, int>, int> border;
  int first = 0;
  const auto add_ring = [&](const Ring2& ring) {
    const int size = static_cast<int>(ring.size());
    for (int i = 0; i < size; ++i) {
      border[{first + i, first + (i + 1) % size}] = 1;
      EXPECT_EQ(t.vertices[static_cast<size_t>(first + i)], ring[static_cast<size_t>(i)]);
    }
    first += size;
  };
  add_ring(polygon.outer);
  for (const Ring2& hole : polygon.holes) add_ring(hole);
  EXPECT_EQ(static_cast<size_t>(first), t.vertices.size());
  EXPECT_EQ(open, border);
  // Euler: n vertices and h holes give n + 2h − 2 triangles.
  EXPECT_EQ(t.triangles.size(), t.vertices.size() + 2 * polygon.holes.size() - 2);
}

TEST(Triangulate, KnownShapes) {
  ExpectCovers({ParseRing("0,0 1,0 0,1"), {}});
  ExpectCovers({ParseRing("0,0 4,0 4,4 0,4"), {}});
  ExpectCovers({ParseRing("0,0 4,0 4,2 2,2 2,4 0,4"), {}});
  ExpectCovers({ParseRing("0,0 2,0 4,0 4,4 2,4 0,4"), {}});  // vertices on straight edges
}

TEST(Triangulate, Holes) {
  ExpectCovers({ParseRing("0,0 9,0 9,9 0,9"), {ParseRing("1,1 1,2 2,2 2,1")}});
  ExpectCovers({ParseRing("0,0 9,0 9,9 0,9"),
                {ParseRing("1,1 1,2 2,2 2,1"), ParseRing("3,3 3,8 8,8 8,7 4,7 4,3")}});
}

TEST(Triangulate, RandomStarsWithAHole) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> radius(1, 3), inner_radius(0.1, 0.6);
  for (int i = 0; i < 30; ++i) {
    Polygon2 polygon;
    polygon.holes.resize(1);
    for (int k = 0; k < 20; ++k) {
      const double angle = 2 * kPi * k / 20;
      polygon.outer.push_back(radius(random) * Vector2d(std::cos(angle), std::sin(angle)));
      polygon.holes[0].push_back(inner_radius(random) *
                                 Vector2d(std::cos(angle), -std::sin(angle)));
    }
    ExpectCovers(polygon);
  }
}

TEST(Triangulate, SameTrianglesEveryTime) {
  const Polygon2 polygon{ParseRing("0,0 4,0 4,2 2,2 2,4 0,4"), {}};
  EXPECT_EQ(Triangulate(polygon).triangles, Triangulate(polygon).triangles);
}

TEST(Triangulate, BadRingsAreBugs) {
  EXPECT_THROW((void)Triangulate({}), std::logic_error);
  EXPECT_THROW((void)Triangulate({ParseRing("0,0 1,0"), {}}), std::logic_error);
  EXPECT_THROW((void)Triangulate({ParseRing("0,0 4,4 4,0 0,4"), {}}), std::logic_error);
  EXPECT_THROW((void)Triangulate({ParseRing("0,0 4,0 4,4 4,4 0,4"), {}}), std::logic_error);
  EXPECT_THROW((void)Triangulate({{{0, 0}, {4, std::nan("")}, {4, 4}}, {}}), std::logic_error);
  EXPECT_THROW((void)Triangulate({ParseRing("0,0 4,0 4,4 0,4"), {ParseRing("0,0 1,2 2,1")}}),
               std::logic_error);
}

}  // namespace
}  // namespace enfilade
