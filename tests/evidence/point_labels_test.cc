// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/point_labels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

SurfaceLabel Label(double z, const Eigen::Vector3d& normal) {
  ScenePoint point;
  point.position = {0, 0, z};
  if (!normal.isZero(0)) point.normal = normal.normalized();
  return LabelOfPoint(point, 0, 2.5);
}

// Leaning by so many degrees from straight up.
Eigen::Vector3d Leaning(double deg) {
  return {std::sin(DegToRad(deg)), 0, std::cos(DegToRad(deg))};
}

TEST(LabelOfPoint, ByHeightAndNormal) {
  EXPECT_EQ(Label(0.05, {0, 0, 1}), SurfaceLabel::kFloor);
  EXPECT_EQ(Label(0.05, {0, 0, -1}), SurfaceLabel::kOther);
  EXPECT_EQ(Label(0.8, {0, 0, 1}), SurfaceLabel::kOther);  // a table
  EXPECT_EQ(Label(2.4, {0.1, 0, -1}), SurfaceLabel::kCeiling);
  EXPECT_EQ(Label(1.2, {1, 0, 0.2}), SurfaceLabel::kWall);
  EXPECT_EQ(Label(1.2, {1, 0, 0.4}), SurfaceLabel::kOther);
  EXPECT_EQ(Label(0.05, {1, 0, 0}), SurfaceLabel::kWall);  // a baseboard: the normal decides
  EXPECT_EQ(Label(-0.05, {1, 0, 0}), SurfaceLabel::kOther);
}

TEST(LabelOfPoint, WithinThirtyCentimetresAndFifteenDegrees) {
  EXPECT_EQ(Label(-0.299, Leaning(0)), SurfaceLabel::kFloor);
  EXPECT_EQ(Label(-0.301, Leaning(0)), SurfaceLabel::kOther);
  EXPECT_EQ(Label(0.299, Leaning(14.9)), SurfaceLabel::kFloor);
  EXPECT_EQ(Label(0.301, Leaning(14.9)), SurfaceLabel::kOther);
  EXPECT_EQ(Label(0.299, Leaning(15.1)), SurfaceLabel::kOther);
  EXPECT_EQ(Label(2.201, Leaning(165.1)), SurfaceLabel::kCeiling);
  EXPECT_EQ(Label(2.799, Leaning(180)), SurfaceLabel::kCeiling);
  EXPECT_EQ(Label(2.801, Leaning(180)), SurfaceLabel::kOther);
  EXPECT_EQ(Label(1, Leaning(75.1)), SurfaceLabel::kWall);
  EXPECT_EQ(Label(1, Leaning(104.9)), SurfaceLabel::kWall);
  EXPECT_EQ(Label(1, Leaning(74.9)), SurfaceLabel::kOther);
}

TEST(LabelOfPoint, WithoutANormalByHeight) {
  EXPECT_EQ(Label(1.2, {0, 0, 0}), SurfaceLabel::kWall);
  EXPECT_EQ(Label(0.1, {0, 0, 0}), SurfaceLabel::kFloor);
  EXPECT_EQ(Label(2.4, {0, 0, 0}), SurfaceLabel::kCeiling);
  EXPECT_EQ(Label(NAN, {0, 0, 0}), SurfaceLabel::kOther);
}

}  // namespace
}  // namespace enfilade
