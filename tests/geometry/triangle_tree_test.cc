// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/triangle_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The twin: every triangle, by solving origin + t·d = a + u·(b − a) + v·(c − a) in doubles.
// `margin` tells how clearly the ray meets or misses the triangles' edges.
std::optional<TriangleHit> SlowFirstHit(const std::vector<Vector3f>& vertices,
                                        const std::vector<std::array<int, 3>>& triangles,
                                        const Vector3f& origin, const Vector3f& direction,
                                        double* margin) {
  std::optional<TriangleHit> first;
  *margin = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Vector3d a = vertices[static_cast<size_t>(triangles[i][0])].cast<double>();
    Matrix3d m;
    m.col(0) = -direction.cast<double>();
    m.col(1) = vertices[static_cast<size_t>(triangles[i][1])].cast<double>() - a;
    m.col(2) = vertices[static_cast<size_t>(triangles[i][2])].cast<double>() - a;
    const Vector3d solution = m.fullPivLu().solve(origin.cast<double>() - a);
    const double inside =
        std::min({solution.y(), solution.z(), 1 - solution.y() - solution.z(), solution.x()});
    *margin = std::min(*margin, std::abs(inside));
    if (inside < 0 || (first && solution.x() >= first->distance)) continue;
    first = {static_cast<int>(i), static_cast<float>(solution.x())};
  }
  return first;
}

// Points of a cube, each call the next.
class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : random_(seed) {}
  Vector3f operator()() { return {place_(random_), place_(random_), place_(random_)}; }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<float> place_{-2, 2};
};

struct Triangles {
  std::vector<Vector3f> vertices;
  std::vector<std::array<int, 3>> triangles;
};

Triangles TriangleSoup(RandomPoints& point) {
  Triangles soup;
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(point());
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

TEST(TriangleTree, AgreesWithItsBruteForceTwin) {
  RandomPoints point(5);
  const auto [vertices, triangles] = TriangleSoup(point);
  const TriangleTree tree(vertices, triangles);
  int num_hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3f origin = point(), direction = point().normalized();
    double margin = 0;
    const auto expected = SlowFirstHit(vertices, triangles, origin, direction, &margin);
    if (margin < 1e-4) continue;
    const auto found = tree.FirstHit(origin, direction, 0, kInfinity);
    ASSERT_EQ(found.has_value(), expected.has_value());
    EXPECT_EQ(tree.IsHit(origin, direction, 0, kInfinity), expected.has_value());
    if (!expected) continue;
    ++num_hits;
    EXPECT_EQ(found->triangle_idx, expected->triangle_idx);
    EXPECT_NEAR(found->distance, expected->distance, 1e-4);
    EXPECT_FALSE(tree.FirstHit(origin, direction, 0, found->distance - 0.01f));
    EXPECT_FALSE(tree.IsHit(origin, direction, 0, found->distance - 0.01f));
  }
  EXPECT_GT(num_hits, 200);
}

TEST(TriangleTree, ManyRaysGiveWhatEachGives) {
  RandomPoints point(6);
  const auto [vertices, triangles] = TriangleSoup(point);
  const TriangleTree tree(vertices, triangles);
  for (const size_t num_rays : {1, 2, 3, 4, 5, 203}) {
    const Vector3f origin = point();
    std::vector<Vector3f> directions(num_rays);
    std::vector<float> far(num_rays);
    for (size_t i = 0; i < num_rays; ++i) {
      directions[i] = point().normalized();
      far[i] = point().x() + 1;  // some lie before `near`
    }
    std::vector<std::optional<TriangleHit>> hits(num_rays);
    tree.FirstHits(origin, directions, 0.1f, 3, hits);
    const auto are_hit = std::make_unique<bool[]>(num_rays);
    tree.AreHit(origin, directions, 0.1f, far, {are_hit.get(), num_rays});
    for (size_t i = 0; i < num_rays; ++i) {
      const auto expected = tree.FirstHit(origin, directions[i], 0.1f, 3);
      ASSERT_EQ(hits[i].has_value(), expected.has_value());
      EXPECT_EQ(are_hit[i], tree.IsHit(origin, directions[i], 0.1f, far[i]));
      if (!expected) continue;
      EXPECT_EQ(hits[i]->triangle_idx, expected->triangle_idx);
      EXPECT_FLOAT_EQ(hits[i]->distance, expected->distance);
    }
  }
}

TEST(TriangleTree, OfNothingIsNeverHit) {
  const TriangleTree tree({}, {});
  EXPECT_FALSE(tree.FirstHit(Vector3f::Zero(), Vector3f::UnitX(), 0, kInfinity));
  EXPECT_FALSE(tree.IsHit(Vector3f::Zero(), Vector3f::UnitX(), 0, kInfinity));
}

}  // namespace
}  // namespace enfilade
