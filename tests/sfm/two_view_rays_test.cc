// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/two_view.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d RandomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

TwoViewGeometry RandomGeometry(std::mt19937& random) {
  return {Eigen::Quaterniond::FromTwoVectors(RandomDirection(random), RandomDirection(random))
              .toRotationMatrix(),
          RandomDirection(random)};
}

// A point 0.5 to 5 baselines away as both cameras see it, b at the end of the baseline.
struct Sight {
  Vector3d ray_a, ray_b;
  double depth_a, depth_b;
};

Sight RandomSight(const TwoViewGeometry& geometry, std::mt19937& random) {
  const double depth = std::uniform_real_distribution<double>(0.5, 5)(random);
  const Vector3d in_a = depth * RandomDirection(random);
  const Vector3d in_b = geometry.a_from_b.transpose() * (in_a - geometry.direction);
  return {in_a.normalized(), in_b.normalized(), in_a.norm(), in_b.norm()};
}

// Least angle by which both rays together have to turn to lie in one plane with the direction: all
// planes through the direction are tried.
double AngleToCommonPlane(const TwoViewGeometry& geometry, const Vector3d& ray_a,
                          const Vector3d& ray_b) {
  const Vector3d b = geometry.a_from_b * ray_b;
  const Vector3d u = geometry.direction.unitOrthogonal(), v = geometry.direction.cross(u);
  const auto angle_at = [&](double azimuth) {
    const Vector3d normal = std::cos(azimuth) * u + std::sin(azimuth) * v;
    return std::hypot(std::asin(normal.dot(ray_a)), std::asin(normal.dot(b)));
  };
  double best = 0, step = kPi / 720;
  for (int k = 0; k < 720; ++k) {
    if (angle_at(k * kPi / 720) < angle_at(best)) best = k * kPi / 720;
  }
  for (; step > 1e-9; step /= 2) {
    for (const double at : {best - step, best + step}) {
      if (angle_at(at) < angle_at(best)) best = at;
    }
  }
  return angle_at(best);
}

TEST(EpipolarError, IsZeroForTrueRays) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const TwoViewGeometry geometry = RandomGeometry(random);
    const Sight sight = RandomSight(geometry, random);
    EXPECT_NEAR(EpipolarError(geometry, sight.ray_a, sight.ray_b), 0, 1e-12);
  }
}

// First order: rays that err by an angle e are judged right up to e².
TEST(EpipolarError, IsTheLeastTurnOfBothRays) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const TwoViewGeometry geometry = RandomGeometry(random);
    const Sight sight = RandomSight(geometry, random);
    // Near the baseline's direction the error is of the order of the distance to it.
    if (sight.ray_a.cross(geometry.direction).norm() < 0.1) continue;
    if ((geometry.a_from_b * sight.ray_b).cross(geometry.direction).norm() < 0.1) continue;
    const double noise_rad = DegToRad(0.1);
    const Vector3d a = (sight.ray_a + noise_rad * RandomDirection(random)).normalized();
    const Vector3d b = (sight.ray_b + noise_rad * RandomDirection(random)).normalized();
    const double truth = AngleToCommonPlane(geometry, a, b);
    EXPECT_NEAR(std::abs(EpipolarError(geometry, a, b)), truth, 0.02 * truth + 1e-6);
  }
}

TEST(EpipolarError, ItsSignTellsTheSide) {
  const TwoViewGeometry geometry{Matrix3d::Identity(), Vector3d::UnitX()};
  const Vector3d a = Vector3d(1, 1, 0).normalized();
  const double above = EpipolarError(geometry, a, Vector3d(-1, 1, 0.01).normalized());
  const double below = EpipolarError(geometry, a, Vector3d(-1, 1, -0.01).normalized());
  EXPECT_NEAR(above, -below, 1e-12);
  EXPECT_GT(std::abs(above), 1e-3);
}

TEST(EpipolarError, IsFiniteAlongTheBaseline) {
  const TwoViewGeometry geometry{Matrix3d::Identity(), Vector3d::UnitX()};
  EXPECT_NEAR(EpipolarError(geometry, Vector3d::UnitX(), Vector3d::UnitX()), 0, 1e-9);
}

// Twin: the least squares over both distances, |depth_a · a − direction − depth_b · b|².
TEST(TriangulateDepths, IsTheLeastSquaresAnswer) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const TwoViewGeometry geometry = RandomGeometry(random);
    const Vector3d ray_a = RandomDirection(random), ray_b = RandomDirection(random);
    Eigen::Matrix<double, 3, 2> rays;
    rays << ray_a, -(geometry.a_from_b * ray_b);
    const Eigen::Vector2d truth = rays.colPivHouseholderQr().solve(geometry.direction);
    const PairDepths depths = TriangulateDepths(geometry, ray_a, ray_b);
    const double scale = 1 + truth.norm();
    EXPECT_NEAR(depths.a, truth[0], 1e-6 * scale);
    EXPECT_NEAR(depths.b, truth[1], 1e-6 * scale);
  }
}

TEST(TriangulateDepths, FindsThePointThatBothSee) {
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const TwoViewGeometry geometry = RandomGeometry(random);
    const Sight sight = RandomSight(geometry, random);
    if (sight.ray_a.cross(geometry.a_from_b * sight.ray_b).norm() < 0.01) continue;
    const PairDepths depths = TriangulateDepths(geometry, sight.ray_a, sight.ray_b);
    EXPECT_NEAR(depths.a, sight.depth_a, 1e-6);
    EXPECT_NEAR(depths.b, sight.depth_b, 1e-6);
    // Looking the other way the point lies behind.
    EXPECT_NEAR(TriangulateDepths(geometry, -sight.ray_a, sight.ray_b).a, -sight.depth_a, 1e-6);
  }
}

TEST(TriangulateDepths, ParallelRaysMeetNowhere) {
  const TwoViewGeometry geometry{RotationZ(1), Vector3d::UnitX()};
  const Vector3d ray(0, 0.6, 0.8);
  const PairDepths depths = TriangulateDepths(geometry, ray, RotationZ(-1) * ray);
  EXPECT_TRUE(std::isinf(depths.a));
  EXPECT_TRUE(std::isinf(depths.b));
}

}  // namespace
}  // namespace enfilade
