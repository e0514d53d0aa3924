// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"
#include "enfilade/sfm/gravity.h"
#include "src/sfm/floor_picture.h"
#include "src/sfm/wall_matches.h"

namespace enfilade {

/// Grey values of a floor, by its level x and y in camera heights.
using FloorTexture = std::function<double(const Eigen::Vector2d& at)>;

/// Patches of random brightness with soft borders, a tenth of a camera height wide, in rows that
/// run otherwise for each seed.
inline FloorTexture RandomFloor(uint32_t seed) {
  return [seed](const Eigen::Vector2d& at) {
    const auto corner = [seed](double x, double y) {
      uint32_t hash = seed * 2654435761U + static_cast<uint32_t>(static_cast<int>(x)) * 73856093U +
                      static_cast<uint32_t>(static_cast<int>(y)) * 19349663U;
      hash = (hash ^ (hash >> 15)) * 2246822519U;
      hash = (hash ^ (hash >> 13)) * 3266489917U;
      return static_cast<double>((hash ^ (hash >> 16)) % 1000) / 1000;
    };
    const Eigen::Vector2d cell = 10 * (Eigen::Rotation2Dd(0.7 * seed) * at),
                          low = cell.array().floor(), part = cell - low;
    const double before =
        (1 - part.x()) * corner(low.x(), low.y()) + part.x() * corner(low.x() + 1, low.y());
    const double behind =
        (1 - part.x()) * corner(low.x(), low.y() + 1) + part.x() * corner(low.x() + 1, low.y() + 1);
    return 60 + 120 * ((1 - part.y()) * before + part.y() * behind);
  };
}

/// Tiles all alike, a third of a camera height wide, with dark joints.
inline double TiledFloor(const Eigen::Vector2d& at) {
  const Eigen::Vector2d part = 3 * at - (3 * at).array().floor().matrix();
  return part.minCoeff() < 0.08 ? 60 : 170;
}

/// A panorama above a floor that goes on forever, under a grey sky, by a room's walls along x and
/// y.
struct FloorPano {
  Eigen::Vector2d at{0, 0};
  double yaw_rad = 0;  ///< of its level frame in the world
  double height = 1;

  [[nodiscard]] Gravity Standing() const {
    Gravity gravity;
    gravity.heading_rad = WrapQuarter(-yaw_rad);
    return gravity;
  }

  [[nodiscard]] FloorPicture Look(const FloorTexture& texture) const {
    constexpr int kRows = 512;
    const Camera camera = EquirectangularCamera(2 * kRows, kRows);
    const Eigen::Matrix3d world_from_cam = RotationZ(yaw_rad) * LevelFromCam(Standing());
    ImageU8 picture(kRows, 2 * kRows, 1, uint8_t{128});
    for (int r = kRows / 2 + 1; r < kRows; ++r) {
      for (int c = 0; c < 2 * kRows; ++c) {
        const Eigen::Vector3d ray = world_from_cam * camera.RayFromPixel({c + 0.5, r + 0.5});
        const Eigen::Vector2d on_floor = at - height / ray.z() * ray.head<2>();
        picture(r, c) = static_cast<uint8_t>(std::lround(texture(on_floor)));
      }
    }
    const ImageU8 trusted(kRows, 2 * kRows, 1, uint8_t{255});
    return LookAtFloor(picture, trusted, camera, CamFromWalls(Standing()));
  }
};

}  // namespace enfilade
