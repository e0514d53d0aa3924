// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/level_panorama.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/structure/types.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNoStand = -kPi;

// Camera axes (x right, y down, z forward) in a world where it looks along +y, upright.
Matrix3d LooksAlongY() {
  Matrix3d m;
  m.col(0) = Vector3d(1, 0, 0);
  m.col(1) = Vector3d(0, 0, -1);
  m.col(2) = Vector3d(0, 1, 0);
  return m;
}

Rigid3 TiltedPose() {
  const Matrix3d tilt = AngleAxisd(0.21, Vector3d(0.6, 0.8, 0)).toRotationMatrix();
  return {RotationZ(1.1) * tilt * LooksAlongY(), {2, -3, 1.5}};
}

// A smooth colour of every direction of the world.
Vector3d ColourOfRay(const Vector3d& ray) { return 127.5 * Vector3d(1, 1, 1) + 120 * ray; }

ImageU8 DrawPicture(const View& view) {
  ImageU8 picture(view.camera.height, view.camera.width, 3);
  for (int r = 0; r < picture.rows(); ++r) {
    for (int c = 0; c < picture.cols(); ++c) {
      const Vector3d colour =
          ColourOfRay(view.world_from_cam.rotation * view.camera.RayFromPixel({c + 0.5, r + 0.5}));
      for (int k = 0; k < 3; ++k) picture(r, c, k) = static_cast<uint8_t>(colour[k] + 0.5);
    }
  }
  return picture;
}

Vector3d RayOfPixel(const LevelPanorama& level, int row, int col) {
  const double azimuth = AzimuthOfColumn(col, level.cols());
  const double elevation = kPi * (0.5 - (row + 0.5) / level.rows());
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

// Largest difference between a seen pixel and the colour of its ray, in grey levels.
double WorstColourError(const LevelPanorama& level, const Rigid3& frame_from_world) {
  double worst = 0;
  for (int r = 0; r < level.rows(); ++r) {
    for (int c = 0; c < level.cols(); ++c) {
      if (!level.is_seen(r, c)) continue;
      const Vector3d colour =
          ColourOfRay(frame_from_world.rotation.transpose() * RayOfPixel(level, r, c));
      for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(level.rgb(r, c, k) - colour[k]));
    }
  }
  return worst;
}

TEST(MakeLevelPanorama, EachPixelShowsItsRayThroughTiltAndHeading) {
  View view;
  view.camera = EquirectangularCamera(512, 256);
  view.world_from_cam = TiltedPose();
  const Rigid3 frame_from_world{RotationZ(-0.4), {1, 2, 3}};
  for (const int width : {512, 256, 128}) {
    const LevelPanorama level =
        MakeLevelPanorama(view, DrawPicture(view), frame_from_world, width, kNoStand);
    EXPECT_EQ(level.rows(), width / 2);
    EXPECT_EQ(level.cols(), width);
    EXPECT_LT((level.position - frame_from_world * view.world_from_cam.translation).norm(), 1e-12);
    // One level of rounding on the way in, half on the way out, and the bend within a pixel.
    EXPECT_LT(WorstColourError(level, frame_from_world), width >= 256 ? 2.5 : 4.0) << width;
    EXPECT_EQ(std::count(level.is_seen.data().begin(), level.is_seen.data().end(), 0), 0);
  }
}

TEST(MakeLevelPanorama, ColumnsTurnCounterClockwiseFromTheBack) {
  View view;
  view.camera = EquirectangularCamera(256, 128);
  view.world_from_cam.rotation = LooksAlongY();
  const LevelPanorama level = MakeLevelPanorama(view, DrawPicture(view), Rigid3(), 256, kNoStand);
  const auto red_green = [&](int col) {
    return Eigen::Vector2i(level.rgb(64, col, 0), level.rgb(64, col, 1));
  };
  EXPECT_GT(red_green(128).x(), 240);    // the middle looks along +x,
  EXPECT_GT(red_green(192).y(), 240);    // to its right comes +y,
  EXPECT_LT(red_green(0).x(), 15);       // the border is −x
  EXPECT_LT(red_green(64).y(), 15);      // and between lies −y.
  EXPECT_GT(level.rgb(0, 17, 2), 240);   // Row 0 looks up,
  EXPECT_LT(level.rgb(127, 17, 2), 15);  // the last row down.
  EXPECT_NEAR(level.RowOfElevation(0), 64, 1e-9);
  EXPECT_NEAR(level.RowOfElevation(kPi / 4), 32, 1e-9);
}

TEST(MakeLevelPanorama, PinholeViewCoversItsFieldAlone) {
  View view;
  view.camera = PinholeCamera(200, 120, 110, 105, 96, 63);
  view.world_from_cam = TiltedPose();
  const Rigid3 frame_from_world{RotationZ(0.7), {0, 0, 0}};
  const LevelPanorama level =
      MakeLevelPanorama(view, DrawPicture(view), frame_from_world, 512, kNoStand);
  EXPECT_LT(WorstColourError(level, frame_from_world), 2.5);
  const Matrix3d cam_from_frame =
      (frame_from_world.rotation * view.world_from_cam.rotation).transpose();
  int num_seen = 0;
  for (int r = 0; r < level.rows(); ++r) {
    for (int c = 0; c < level.cols(); ++c) {
      const Vector3d ray = cam_from_frame * RayOfPixel(level, r, c);
      const double x = 110 * ray.x() / ray.z() + 96, y = 105 * ray.y() / ray.z() + 63;
      const bool is_inside = ray.z() > 0 && x >= 0 && x < 200 && y >= 0 && y < 120;
      ASSERT_EQ(level.is_seen(r, c) != 0, is_inside) << r << ", " << c;
      num_seen += is_inside;
    }
  }
  EXPECT_GT(num_seen, 5000);
}

TEST(MakeLevelPanorama, MaskedPixelsAreUnseen) {
  const TempFolder folder;
  ImageU8 mask(64, 128, 1, 255);
  for (int r = 0; r < 64; ++r) {
    for (int c = 0; c < 64; ++c) mask(r, c) = 0;
  }
  WriteImage(folder / "mask.png", mask);
  View view;
  view.camera = EquirectangularCamera(128, 64);
  view.world_from_cam.rotation = LooksAlongY();
  view.mask_path = folder / "mask.png";
  const LevelPanorama level = MakeLevelPanorama(view, DrawPicture(view), Rigid3(), 128, kNoStand);
  // The left half of the picture lies to the left of +y: where x is negative.
  for (int c = 0; c < 128; ++c) {
    const bool is_left = std::cos(AzimuthOfColumn(c, 128)) < 0;
    EXPECT_EQ(level.is_seen(32, c) != 0, !is_left) << c;
  }
}

TEST(MakeLevelPanorama, TheStandIsUnseen) {
  View view;
  view.camera = EquirectangularCamera(128, 64);
  view.world_from_cam = TiltedPose();
  const double stand = DegToRad(-60);
  const LevelPanorama level = MakeLevelPanorama(view, DrawPicture(view), Rigid3(), 128, stand);
  for (int r = 0; r < 64; ++r) {
    const bool is_stand = kPi * (0.5 - (r + 0.5) / 64) < stand;
    EXPECT_EQ(level.is_seen(r, 5) == 0, is_stand) << r;
  }
}

TEST(MakeLevelPanorama, FinerPicturesAreAveraged) {
  View view;
  view.camera = EquirectangularCamera(512, 256);
  ImageU8 checkers(256, 512, 3);
  for (int r = 0; r < 256; ++r) {
    for (int c = 0; c < 512; ++c) {
      for (int k = 0; k < 3; ++k) checkers(r, c, k) = (r + c) % 2 == 0 ? 0 : 200;
    }
  }
  view.world_from_cam.rotation = LooksAlongY();
  const LevelPanorama level = MakeLevelPanorama(view, checkers, Rigid3(), 128, kNoStand);
  for (int c = 0; c < 128; ++c) EXPECT_NEAR(level.rgb(32, c, 0), 100, 1) << c;
}

TEST(LevelWidth, KeepsTheResolutionUpToAWidth) {
  View view;
  view.camera = EquirectangularCamera(2048, 1024);
  EXPECT_EQ(LevelWidth(view, 4096), 2048);
  EXPECT_EQ(LevelWidth(view, 1024), 1024);
  view.camera = PinholeCamera(200, 120, 100, 100, 100, 60);
  EXPECT_EQ(LevelWidth(view, 4096), 628);  // 2π · 100, even
}

}  // namespace
}  // namespace enfilade
