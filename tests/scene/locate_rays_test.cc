// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/locate_rays.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "enfilade/scene/camera.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

TEST(LocateRays, AgreesWithTheCameraModelTo500thOfAPixel) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> metres(-4, 4);
  for (const int height : {64, 1024, 8192}) {
    const Camera camera = EquirectangularCamera(2 * height, height);
    for (int trial = 0; trial < 200; ++trial) {
      const Vector3d first(metres(random), metres(random), metres(random));
      const Vector3d step = 0.02 * Vector3d(metres(random), metres(random), metres(random));
      std::array<float, 50> u{}, v{};
      LocateRays(first, step, camera.width, camera.height, u, v);
      for (size_t i = 0; i < u.size(); ++i) {
        const Vector3d ray = first + static_cast<double>(i) * step;
        // Near the poles a small way is many columns.
        if (std::hypot(ray.x(), ray.z()) < 0.2 * ray.norm() || ray.norm() < 0.1) continue;
        const Eigen::Vector2d pixel = camera.PixelFromRay(ray).value();
        const double off = u[i] + 0.5 - pixel.x();
        EXPECT_NEAR(off - camera.width * std::round(off / camera.width), 0, 0.002);
        EXPECT_NEAR(v[i] + 0.5, pixel.y(), 0.002);
        EXPECT_GE(u[i], -0.5F);
        EXPECT_LE(u[i], static_cast<float>(camera.width) - 0.5F);
      }
    }
  }
}

}  // namespace
}  // namespace enfilade
