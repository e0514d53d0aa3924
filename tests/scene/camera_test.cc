// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(Equirectangular, DirectionsOfTheConvention) {
  // Camera axes: x right, y down, z forward. The picture's centre looks forward.
  const Camera camera = EquirectangularCamera(2048, 1024);
  const auto expect = [&](const Vector2d& pixel, const Vector3d& ray) {
    EXPECT_LT((camera.RayFromPixel(pixel) - ray).norm(), 1e-12) << pixel.transpose();
    const auto back = camera.PixelFromRay(3 * ray);
    ASSERT_TRUE(back.has_value());
    EXPECT_LT((*back - pixel).norm(), 1e-9) << ray.transpose();
  };
  expect({1024, 512}, {0, 0, 1});                             // forward
  expect({1536, 512}, {1, 0, 0});                             // right
  expect({512, 512}, {-1, 0, 0});                             // left
  expect({0, 512}, {0, 0, -1});                               // back: the left border
  expect({1024, 256}, {0, -std::sqrt(0.5), std::sqrt(0.5)});  // 45° up
  expect({1024, 768}, {0, std::sqrt(0.5), std::sqrt(0.5)});   // 45° down
  EXPECT_LT((camera.RayFromPixel({700, 0}) - Vector3d(0, -1, 0)).norm(), 1e-12);    // zenith
  EXPECT_LT((camera.RayFromPixel({700, 1024}) - Vector3d(0, 1, 0)).norm(), 1e-12);  // nadir
}

TEST(Equirectangular, FormulaOfColmap4) {
  // EQUIRECTANGULAR of COLMAP 4: theta = (x / w − 0.5)·2π, phi = (0.5 − y / h)·π,
  // ray = (cos phi sin theta, −sin phi, cos phi cos theta); evaluated by hand at (100.5, 300.5).
  const Camera camera = EquirectangularCamera(1000, 500);
  const double theta = (100.5 / 1000 - 0.5) * 2 * kPi, phi = (0.5 - 300.5 / 500) * kPi;
  const Vector3d ray = camera.RayFromPixel({100.5, 300.5});
  EXPECT_NEAR(ray.x(), std::cos(phi) * std::sin(theta), 1e-15);
  EXPECT_NEAR(ray.y(), -std::sin(phi), 1e-15);
  EXPECT_NEAR(ray.z(), std::cos(phi) * std::cos(theta), 1e-15);
  EXPECT_NEAR(ray.x(), -0.56086, 1e-5);
  EXPECT_NEAR(ray.y(), 0.31201, 1e-5);
  EXPECT_NEAR(ray.z(), -0.76687, 1e-5);
}

TEST(Equirectangular, RoundTripOfEveryPixel) {
  const Camera camera = EquirectangularCamera(64, 32);
  for (int row = 0; row < 32; ++row) {
    for (int col = 0; col < 64; ++col) {
      const Vector2d pixel(col + 0.5, row + 0.5);
      const Vector3d ray = camera.RayFromPixel(pixel);
      EXPECT_NEAR(ray.norm(), 1, 1e-14);
      EXPECT_LT((*camera.PixelFromRay(ray) - pixel).norm(), 1e-10);
    }
  }
}

TEST(Equirectangular, EveryRayHasAPixel) {
  const Camera camera = EquirectangularCamera(200, 100);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d ray(normal(random), normal(random), normal(random));
    const auto pixel = camera.PixelFromRay(ray);
    ASSERT_TRUE(pixel.has_value());
    EXPECT_GE(pixel->x(), 0);
    EXPECT_LT(pixel->x(), 200);
    EXPECT_GE(pixel->y(), 0);
    EXPECT_LE(pixel->y(), 100);
    EXPECT_LT((camera.RayFromPixel(*pixel) - ray.normalized()).norm(), 1e-12);
  }
}

TEST(Equirectangular, SeamBehindTheCamera) {
  const Camera camera = EquirectangularCamera(200, 100);
  EXPECT_EQ(camera.PixelFromRay({0.0, 0, -1})->x(), 0);
  EXPECT_EQ(camera.PixelFromRay({-0.0, 0, -1})->x(), 0);
  EXPECT_NEAR(camera.PixelFromRay({1e-9, 0, -1})->x(), 200, 1e-6);
  EXPECT_NEAR(camera.PixelFromRay({-1e-9, 0, -1})->x(), 0, 1e-6);
}

TEST(Pinhole, RoundTripOfEveryPixel) {
  const Camera camera = PinholeCamera(40, 30, 25, 26, 19, 16);
  for (int row = 0; row < 30; ++row) {
    for (int col = 0; col < 40; ++col) {
      const Vector2d pixel(col + 0.5, row + 0.5);
      const Vector3d ray = camera.RayFromPixel(pixel);
      EXPECT_NEAR(ray.norm(), 1, 1e-14);
      const auto back = camera.PixelFromRay(7 * ray);
      ASSERT_TRUE(back.has_value());
      EXPECT_LT((*back - pixel).norm(), 1e-10);
    }
  }
}

TEST(Pinhole, PrincipalPointLooksForward) {
  const Camera camera = PinholeCamera(40, 30, 25, 26, 19, 16);
  EXPECT_LT((camera.RayFromPixel({19, 16}) - Vector3d(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((camera.RayFromPixel({19 + 25, 16}) - Vector3d(1, 0, 1).normalized()).norm(), 1e-15);
  EXPECT_LT((camera.RayFromPixel({19, 16 + 26}) - Vector3d(0, 1, 1).normalized()).norm(), 1e-15);
}

TEST(Pinhole, NothingBehindOrOutside) {
  const Camera camera = PinholeCamera(40, 30, 25, 25, 20, 15);
  EXPECT_TRUE(camera.PixelFromRay({0, 0, 1}).has_value());
  EXPECT_FALSE(camera.PixelFromRay({0, 0, -1}).has_value());
  EXPECT_FALSE(camera.PixelFromRay({0, 0, 0}).has_value());
  EXPECT_FALSE(camera.PixelFromRay({1, 0, 0}).has_value());
  EXPECT_FALSE(camera.PixelFromRay({20.01, 0, 25}).has_value());
  EXPECT_TRUE(camera.PixelFromRay({19.99, 0, 25}).has_value());
  EXPECT_TRUE(camera.PixelFromRay({-20, -15, 25}).has_value());  // the top-left corner
  EXPECT_FALSE(camera.PixelFromRay({0, 15, 25}).has_value());    // the bottom edge is outside
}

TEST(Camera, EmptyPicturesAreBugs) {
  EXPECT_THROW((void)EquirectangularCamera(0, 10), std::logic_error);
  EXPECT_THROW((void)EquirectangularCamera(10, -1), std::logic_error);
  EXPECT_THROW((void)PinholeCamera(10, 10, 0, 1, 5, 5), std::logic_error);
  EXPECT_THROW((void)PinholeCamera(10, 10, 1, std::nan(""), 5, 5), std::logic_error);
}

}  // namespace
}  // namespace enfilade
