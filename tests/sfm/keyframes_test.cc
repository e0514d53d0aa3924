// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/keyframes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<Vector3d> PointsAround(int count, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const Vector3d direction(normal(random), 0.4 * normal(random), normal(random));
    points.push_back((2 + 0.5 * std::abs(normal(random))) * direction.normalized());
  }
  return points;
}

std::vector<Vector3d> RaysFrom(const Vector3d& center, const Matrix3d& cam_from_world,
                               const std::vector<Vector3d>& points) {
  std::vector<Vector3d> rays;
  for (const Vector3d& point : points) {
    rays.push_back((cam_from_world * (point - center)).normalized());
  }
  return rays;
}

Matrix3d Turn(double deg) {
  return Eigen::AngleAxisd(DegToRad(deg), Vector3d(0.2, 1, -0.3).normalized()).toRotationMatrix();
}

double AngleDeg(const Matrix3d& a, const Matrix3d& b) {
  return RadToDeg(Eigen::AngleAxisd(a.transpose() * b).angle());
}

TEST(FitRotation, FindsTheTurnAmongAThirdOfWrongRays) {
  const std::vector<Vector3d> first =
      RaysFrom({0, 0, 0}, Matrix3d::Identity(), PointsAround(90, 1));
  for (const double deg : {0.0, 1.0, 25.0, 170.0}) {
    std::vector<Vector3d> second;
    for (const Vector3d& ray : first) second.push_back(Turn(deg) * ray);
    EXPECT_LT(AngleDeg(*FitRotation(first, second), Turn(deg)), 1e-6);
    const std::vector<Vector3d> wrong = RaysFrom({0, 0, 0}, Turn(40), PointsAround(30, 2));
    for (size_t i = 0; i < 30; ++i) second[3 * i] = wrong[i];
    EXPECT_LT(AngleDeg(*FitRotation(first, second), Turn(deg)), 0.2) << deg;
  }
}

TEST(FitRotation, NeedsThreeRaysThatDiffer) {
  const std::vector<Vector3d> two = {Vector3d::UnitX(), Vector3d::UnitY()};
  const std::vector<Vector3d> parallel(5, Vector3d::UnitZ());
  EXPECT_FALSE(FitRotation(two, two));
  EXPECT_FALSE(FitRotation({}, {}));
  EXPECT_FALSE(FitRotation(parallel, parallel));
  EXPECT_FALSE(MedianParallax(parallel, parallel));
}

TEST(MedianParallax, IsThatOfTheStepWhateverTheTurn) {
  const std::vector<Vector3d> points = PointsAround(300, 3);
  const std::vector<Vector3d> first = RaysFrom({0, 0, 0}, Matrix3d::Identity(), points);
  EXPECT_NEAR(*MedianParallax(first, RaysFrom({0, 0, 0}, Turn(60), points)), 0, 1e-7);
  const Vector3d step(0.15, 0, 0.1);
  const double still = *MedianParallax(first, RaysFrom(step, Matrix3d::Identity(), points));
  EXPECT_NEAR(*MedianParallax(first, RaysFrom(step, Turn(60), points)), still, 1e-6);
  std::vector<double> angles;
  for (const Vector3d& point : points) {
    angles.push_back(std::acos(point.normalized().dot((point - step).normalized())));
  }
  std::nth_element(angles.begin(), angles.begin() + 150, angles.end());
  EXPECT_NEAR(still, angles[150], 0.1 * angles[150]);
}

// Frames at x = 0, step, 2 step, … that see the points all round; `first_id` counts up where all
// tracks are lost.
std::vector<TrackedFrame> Walk(const std::vector<Vector3d>& points, double step_m, int count,
                               const Camera& camera, int lost_at = -1) {
  std::vector<TrackedFrame> frames;
  int first_id = 0;
  for (int f = 0; f < count; ++f) {
    if (f == lost_at) first_id += static_cast<int>(points.size());
    const std::vector<Vector3d> rays = RaysFrom({f * step_m, 0, 0}, Turn(5.0 * f), points);
    TrackedFrame& frame = frames.emplace_back();
    for (size_t i = 0; i < rays.size(); ++i) {
      frame.points.push_back({first_id + static_cast<int>(i), *camera.PixelFromRay(rays[i])});
    }
  }
  return frames;
}

TEST(SelectKeyframes, AreAsFarApartAsTheParallaxAsks) {
  const Camera camera = EquirectangularCamera(1024, 512);
  const std::vector<Vector3d> points = PointsAround(300, 4);
  const std::vector<TrackedFrame> frames = Walk(points, 0.02, 40, camera);
  KeyframeOptions options;
  options.min_parallax_deg = 3;
  const std::vector<int> keyframes = SelectKeyframes(frames, camera, options);
  ASSERT_GE(keyframes.size(), 4u);
  EXPECT_EQ(keyframes[0], 0);
  // Points 2 to 3 m away: 3° of parallax in the median take 12 to 22 cm.
  for (size_t i = 1; i < keyframes.size(); ++i) {
    EXPECT_GE(keyframes[i] - keyframes[i - 1], 6);
    EXPECT_LE(keyframes[i] - keyframes[i - 1], 11);
  }
}

TEST(SelectKeyframes, ATurnOnTheSpotMakesNone) {
  const Camera camera = EquirectangularCamera(1024, 512);
  EXPECT_EQ(SelectKeyframes(Walk(PointsAround(100, 5), 0, 30, camera), camera, {}),
            std::vector<int>{0});
}

TEST(SelectKeyframes, KeepsBothSidesOfALoss) {
  const Camera camera = EquirectangularCamera(1024, 512);
  EXPECT_EQ(SelectKeyframes(Walk(PointsAround(100, 6), 0, 30, camera, 12), camera, {}),
            (std::vector<int>{0, 11, 12}));
  EXPECT_TRUE(SelectKeyframes({}, camera, {}).empty());
  // Frames without any features have nothing to lose.
  EXPECT_EQ(SelectKeyframes(std::vector<TrackedFrame>(5), camera, {}), std::vector<int>{0});
}

}  // namespace
}  // namespace enfilade
