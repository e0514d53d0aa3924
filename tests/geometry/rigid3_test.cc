// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/rigid3.h"

#include <gtest/gtest.h>

#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class Rigid3Test : public testing::Test {
 protected:
  Vector3d RandomVector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }
  Matrix3d RandomRotation() {
    return Eigen::AngleAxisd(3 * uniform_(random_), RandomVector().normalized()).toRotationMatrix();
  }
  Rigid3 RandomRigid() { return {RandomRotation(), 5 * RandomVector()}; }

 private:
  std::mt19937 random_{10};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST_F(Rigid3Test, GroupLaws) {
  for (int i = 0; i < 50; ++i) {
    const Rigid3 a_from_b = RandomRigid(), b_from_c = RandomRigid();
    const Vector3d x_in_c = RandomVector();
    EXPECT_TRUE((a_from_b * b_from_c * x_in_c).isApprox(a_from_b * (b_from_c * x_in_c), 1e-12));
    EXPECT_TRUE((a_from_b.Inverse() * a_from_b).Matrix().isIdentity(1e-12));
    EXPECT_TRUE((a_from_b * a_from_b.Inverse()).Matrix().isIdentity(1e-12));
    EXPECT_TRUE(
        (a_from_b * b_from_c).Matrix().isApprox(a_from_b.Matrix() * b_from_c.Matrix(), 1e-12));
    EXPECT_TRUE((Rigid3() * x_in_c).isApprox(x_in_c));
  }
}

TEST_F(Rigid3Test, RotationZIsCounterClockwiseFromAbove) {
  EXPECT_TRUE((RotationZ(kPi / 2) * Vector3d::UnitX()).isApprox(Vector3d::UnitY(), 1e-15));
  EXPECT_TRUE((RotationZ(0.3) * RotationZ(0.4)).isApprox(RotationZ(0.7), 1e-15));
}

TEST_F(Rigid3Test, NearestRotationOfRoundedEntries) {
  for (int i = 0; i < 50; ++i) {
    const Matrix3d rotation = RandomRotation();
    const Matrix3d rounded = (rotation * 1000).array().round().matrix() / 1000;
    const Matrix3d nearest = NearestRotation(rounded);
    EXPECT_TRUE((nearest * nearest.transpose()).isIdentity(1e-12));
    EXPECT_NEAR(nearest.determinant(), 1, 1e-12);
    EXPECT_LT((nearest - rotation).norm(), 3e-3);
    EXPECT_LE((nearest - rounded).norm(), (rotation - rounded).norm() + 1e-12);
  }
}

TEST_F(Rigid3Test, NearestRotationKeepsRotationsAndIsNeverAReflection) {
  const Matrix3d rotation = RandomRotation();
  EXPECT_TRUE(NearestRotation(rotation).isApprox(rotation, 1e-12));
  EXPECT_TRUE(NearestRotation(4 * rotation).isApprox(rotation, 1e-12));  // scale falls away
  const Matrix3d reflection = rotation * Vector3d(1, 1, -1).asDiagonal();
  EXPECT_NEAR(NearestRotation(reflection).determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace enfilade
