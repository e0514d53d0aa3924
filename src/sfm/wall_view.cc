// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/wall_view.h"

#include <Eigen/Geometry>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Matrix3d WallViewFrame(int view) {
  Vector3d forward = Vector3d::UnitZ(), down = -Vector3d::UnitX();
  if (view < kNumLevelWallViews) {
    const double azimuth = view * kPi / 2;
    forward = {std::round(std::cos(azimuth)), std::round(std::sin(azimuth)), 0};
    down = -Vector3d::UnitZ();
  } else if (view == kFloorWallView) {
    forward = -Vector3d::UnitZ();
  }
  Matrix3d frame;
  frame << down.cross(forward), down, forward;
  return frame;
}

MovedView MoveView(int view, const Matrix3d& moved_from_frame) {
  constexpr int kSide = 4, kAngles = 8;
  constexpr double kMiddle = (kSide - 1) / 2.0;
  const Matrix3d axes = moved_from_frame * WallViewFrame(view);
  MovedView moved;
  while (WallViewFrame(moved.view).col(2).dot(axes.col(2)) < 0.5) ++moved.view;
  // New from old axes of the picture: right and down.
  const Eigen::Matrix2d picture =
      (WallViewFrame(moved.view).transpose() * axes).topLeftCorner<2, 2>();
  const auto index = [](double row, double col, int angle) {
    return static_cast<size_t>((std::lround(row) * kSide + std::lround(col)) * kAngles + angle);
  };
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const Vector2d cell = picture * Vector2d(col - kMiddle, row - kMiddle);
      for (int angle = 0; angle < kAngles; ++angle) {
        const double rad = angle * 2 * kPi / kAngles;
        const Vector2d gradient = picture * Vector2d(std::cos(rad), -std::sin(rad));
        const double to_rad = std::atan2(-gradient.y(), gradient.x());
        const int to_angle = static_cast<int>(std::lround(to_rad / (2 * kPi) * kAngles));
        moved.order[index(cell.y() + kMiddle, cell.x() + kMiddle, (to_angle + kAngles) % kAngles)] =
            static_cast<uint8_t>(index(row, col, angle));
      }
    }
  }
  return moved;
}

std::array<MovedView, kNumWallViews> MoveViews(const Matrix3d& moved_from_frame) {
  std::array<MovedView, kNumWallViews> moved;
  for (size_t k = 0; k < moved.size(); ++k) {
    moved[k] = MoveView(static_cast<int>(k), moved_from_frame);
  }
  return moved;
}

}  // namespace enfilade
