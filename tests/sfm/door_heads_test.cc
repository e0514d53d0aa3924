// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/door_heads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUsual = 2.0 / 1.5;

// A vertical line from one height above the floor to another, in camera heights, in the level
// frame.
LineSegment Upright(double azimuth_rad, double distance, double from, double to) {
  const Vector3d foot(distance * std::cos(azimuth_rad), distance * std::sin(azimuth_rad), -1);
  return {(foot + from * Vector3d::UnitZ()).normalized(),
          (foot + to * Vector3d::UnitZ()).normalized()};
}

// Panoramas that see two door frames each, cupboards of one height in a third of them, and corners
// of rooms; ends err by 0.3°.
std::vector<std::vector<UprightEdge>> MakePanoramas(double head, double cupboard, int count) {
  std::mt19937 random(4);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto add = [&](std::vector<UprightEdge>& edges, double height) {
    const double bottom = -1 / between(0.8, 3);
    const double top = (1 - height) * bottom;
    edges.push_back({between(-kPi, kPi), bottom + DegToRad(between(-0.3, 0.3)),
                     top + DegToRad(between(-0.3, 0.3))});
  };
  std::vector<std::vector<UprightEdge>> panoramas(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    std::vector<UprightEdge>& edges = panoramas[static_cast<size_t>(i)];
    for (int k = 0; k < 4; ++k) add(edges, head);
    for (int k = 0; k < 6; ++k) add(edges, i % 3 == 0 ? cupboard : between(1.1, 1.9));
  }
  return panoramas;
}

TEST(UprightEdges, TellWhereLinesEnd) {
  const Matrix3d level = Matrix3d::Identity();
  const auto edges = UprightEdges(std::vector{Upright(0.5, 2, 1.3, 0)}, level);
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_NEAR(edges[0].azimuth_rad, 0.5, 1e-12);
  EXPECT_NEAR(edges[0].bottom, -0.5, 1e-12);
  EXPECT_NEAR(edges[0].top, 0.15, 1e-12);
}

TEST(UprightEdges, JoinPiecesOfOneEdge) {
  const Matrix3d level = Matrix3d::Identity();
  const std::vector<LineSegment> pieces = {
      Upright(0.5, 2, 0.7, 1.3),        Upright(0.505, 2, 0, 0.65),  // 1.1° between them
      Upright(0.6, 2, 0, 0.3),          Upright(0.6, 2, 0.8, 1.3),   // 12°: two edges
      Upright(-kPi + 0.001, 2, 0, 0.6), Upright(kPi - 0.001, 2, 0.6, 1.3)};
  const auto edges = UprightEdges(pieces, level);
  ASSERT_EQ(edges.size(), 4U);
  int num_whole = 0;
  for (const UprightEdge& edge : edges) {
    num_whole += std::abs(edge.bottom + 0.5) < 1e-9 && std::abs(edge.top - 0.15) < 1e-9;
  }
  EXPECT_EQ(num_whole, 2);
}

TEST(UprightEdges, LeaveSlantedLinesOut) {
  const LineSegment slanted{Vector3d(2, 0, -1).normalized(), Vector3d(2, 0.1, 0.3).normalized()};
  EXPECT_TRUE(UprightEdges(std::vector{slanted}, Matrix3d::Identity()).empty());
}

TEST(FindDoorHead, FindsTheHeightThatAllRoomsShare) {
  for (const double head : {1.22, 1.33, 1.45, 1.53}) {
    const auto found = FindDoorHead(MakePanoramas(head, 1.62, 12), kUsual);
    ASSERT_TRUE(found) << head;
    EXPECT_NEAR(*found, head, 0.02);
  }
}

// The two edges of a casing: the door is the lower one.
TEST(FindDoorHead, TakesTheInnerEdgeOfACasing) {
  std::vector<std::vector<UprightEdge>> inner = MakePanoramas(1.40, 1.62, 12);
  const std::vector<std::vector<UprightEdge>> outer = MakePanoramas(1.47, 1.62, 12);
  for (size_t i = 0; i < inner.size(); ++i) {
    inner[i].insert(inner[i].end(), outer[i].begin(), outer[i].end());
  }
  EXPECT_NEAR(FindDoorHead(inner, 2.0 / 1.38).value_or(0), 1.40, 0.02);
}

TEST(FindDoorHead, TooFewEdgesTellNothing) {
  EXPECT_FALSE(FindDoorHead({}, kUsual));
  EXPECT_FALSE(FindDoorHead(std::vector<std::vector<UprightEdge>>(5), kUsual));
  EXPECT_FALSE(FindDoorHead(MakePanoramas(1.33, 1.6, 1), kUsual));
}

}  // namespace
}  // namespace enfilade
