// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/virtual_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Smooth on the sphere, different in each channel: a colour for every direction.
double Colour(const Vector3d& ray, int channel) {
  return 127.5 + 100 * std::sin(2 * ray[channel] + ray[(channel + 1) % 3]);
}

ImageU8 ColouredSphere(const Camera& camera) {
  ImageU8 pano(camera.height, camera.width, 3);
  for (int r = 0; r < camera.height; ++r) {
    for (int c = 0; c < camera.width; ++c) {
      const Vector3d ray = camera.RayFromPixel({c + 0.5, r + 0.5});
      for (int k = 0; k < 3; ++k) {
        pano(r, c, k) = static_cast<uint8_t>(std::lround(Colour(ray, k)));
      }
    }
  }
  return pano;
}

ImageU8 Noise(const Camera& camera, int channels) {
  std::mt19937 random(1);
  ImageU8 pano(camera.height, camera.width, channels);
  for (uint8_t& value : pano.data()) value = static_cast<uint8_t>(random() & 255);
  return pano;
}

Matrix3d Rotation(double yaw_deg, double pitch_deg, double roll_deg) {
  return (AngleAxisd(DegToRad(yaw_deg), Vector3d::UnitY()) *
          AngleAxisd(DegToRad(pitch_deg), Vector3d::UnitX()) *
          AngleAxisd(DegToRad(roll_deg), Vector3d::UnitZ()))
      .toRotationMatrix();
}

const std::vector<Matrix3d> kRotations = {
    Rotation(0, 0, 0),    Rotation(90, 0, 0),     Rotation(180, 0, 0),   Rotation(-137, 0, 0),
    Rotation(0, 90, 0),   Rotation(30, -90, 0),   Rotation(180, -90, 0), Rotation(20, 40, 60),
    Rotation(170, 85, 5), Rotation(180, -88, 180)};

TEST(RenderVirtualView, ShowsTheColourOfEveryDirection) {
  const Camera pano_camera = EquirectangularCamera(1024, 512);
  const Camera view = PinholeCamera(90, 70, 45, 45, 44, 36);
  const ImageU8 pano = ColouredSphere(pano_camera);
  for (const Matrix3d& pano_from_view : kRotations) {
    const ImageU8 image = RenderVirtualView(pano, pano_camera, view, pano_from_view);
    ASSERT_EQ(image.rows(), 70);
    ASSERT_EQ(image.cols(), 90);
    ASSERT_EQ(image.channels(), 3);
    for (int r = 0; r < image.rows(); ++r) {
      for (int c = 0; c < image.cols(); ++c) {
        const Vector3d ray = pano_from_view * view.RayFromPixel({c + 0.5, r + 0.5});
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(image(r, c, k), Colour(ray, k), 1.5);
      }
    }
  }
}

// The slow twin: the exact camera and the library's sampling, pixel by pixel.
void ExpectEqualsTwin(int pano_width, int channels) {
  const Camera pano_camera = EquirectangularCamera(pano_width, pano_width / 2);
  const Camera view = PinholeCamera(61, 47, 25, 31, 30.5, 20);
  const ImageU8 pano = Noise(pano_camera, channels);
  for (const Matrix3d& pano_from_view : kRotations) {
    const ImageU8 image = RenderVirtualView(pano, pano_camera, view, pano_from_view);
    for (int r = 0; r < image.rows(); ++r) {
      for (int c = 0; c < image.cols(); ++c) {
        const Vector3d ray = pano_from_view * view.RayFromPixel({c + 0.5, r + 0.5});
        const Vector2d pixel = *pano_camera.PixelFromRay(ray);
        if (std::hypot(ray.x(), ray.z()) < 1e-6) continue;  // at a pole every column is right
        for (int k = 0; k < channels; ++k) {
          ASSERT_NEAR(image(r, c, k), SampleBilinearWrapped(pano, pixel.x(), pixel.y(), k), 1)
              << r << " " << c << " " << pixel.transpose();
        }
      }
    }
  }
}

TEST(RenderVirtualView, EqualsTheSlowTwinOnNoise) {
  ExpectEqualsTwin(256, 3);
  ExpectEqualsTwin(250, 1);
  ExpectEqualsTwin(2048, 3);
}

TEST(RenderVirtualView, PrincipalPointSeesWhereTheViewLooks) {
  const Camera pano_camera = EquirectangularCamera(400, 200);
  const Camera view = PinholeCamera(21, 21, 10, 10, 10.5, 10.5);
  ImageU8 pano(200, 400, 1);
  pano(100, 300) = pano(99, 300) = pano(100, 299) = pano(99, 299) = 255;  // 90° to the right
  EXPECT_EQ(RenderVirtualView(pano, pano_camera, view, Rotation(90, 0, 0))(10, 10), 255);
  EXPECT_EQ(RenderVirtualView(pano, pano_camera, view, Rotation(-90, 0, 0))(10, 10), 0);
}

TEST(RenderVirtualView, TurningThePanoramaTurnsTheView) {
  // Law: the panorama shifted by a quarter of its columns, seen a quarter turn further, is the
  // same.
  const Camera pano_camera = EquirectangularCamera(512, 256);
  const Camera view = PinholeCamera(64, 64, 32, 32, 32, 32);
  const ImageU8 pano = ColouredSphere(pano_camera);
  ImageU8 shifted(256, 512, 3);
  for (int r = 0; r < 256; ++r) {
    for (int c = 0; c < 512; ++c) {
      for (int k = 0; k < 3; ++k) shifted(r, (c + 128) % 512, k) = pano(r, c, k);
    }
  }
  const ImageU8 a = RenderVirtualView(pano, pano_camera, view, Rotation(10, 20, 0));
  const ImageU8 b = RenderVirtualView(shifted, pano_camera, view, Rotation(100, 20, 0));
  for (size_t i = 0; i < a.data().size(); ++i) ASSERT_NEAR(a.data()[i], b.data()[i], 1);
}

TEST(RenderVirtualView, WrongSizesAndModelsAreBugs) {
  const Camera pano_camera = EquirectangularCamera(64, 32);
  const Camera view = PinholeCamera(8, 8, 4, 4, 4, 4);
  const Matrix3d identity = Matrix3d::Identity();
  const ImageU8 pano(32, 64, 3);
  EXPECT_THROW((void)RenderVirtualView(ImageU8(32, 60, 3), pano_camera, view, identity),
               std::logic_error);
  EXPECT_THROW((void)RenderVirtualView(pano, view, view, identity), std::logic_error);
  EXPECT_THROW((void)RenderVirtualView(pano, pano_camera, pano_camera, identity), std::logic_error);
  EXPECT_THROW((void)RenderVirtualView(ImageU8(32, 64, 2), pano_camera, view, identity),
               std::logic_error);
}

}  // namespace
}  // namespace enfilade
