// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/baselines/oriented_points.h"

namespace enfilade {

/// A voxel or a corner of voxels by its place along x, y and z.
using Voxel = std::array<int, 3>;

/// Where the voxels of a volume lie in the home frame: voxel (i, j, k) has its lower corner at
/// origin + (i, j, k) · voxel_m. Arrays have one entry a voxel, x fastest.
struct VoxelFrame {
  Eigen::Vector3d origin{0, 0, 0};
  double voxel_m = 0.05;
  Voxel size{0, 0, 0};

  [[nodiscard]] size_t NumVoxels() const {
    return static_cast<size_t>(size[0]) * static_cast<size_t>(size[1]) *
           static_cast<size_t>(size[2]);
  }
  [[nodiscard]] size_t Index(const Voxel& v) const {
    return (static_cast<size_t>(v[2]) * static_cast<size_t>(size[1]) + static_cast<size_t>(v[1])) *
               static_cast<size_t>(size[0]) +
           static_cast<size_t>(v[0]);
  }
  /// Between the entries of neighbours along an axis.
  [[nodiscard]] size_t Stride(int axis) const {
    if (axis == 0) return 1;
    return static_cast<size_t>(size[0]) * (axis == 1 ? 1 : static_cast<size_t>(size[1]));
  }
  [[nodiscard]] bool IsInside(const Voxel& v) const {
    for (size_t k = 0; k < 3; ++k) {
      if (v[k] < 0 || v[k] >= size[k]) return false;
    }
    return true;
  }
  [[nodiscard]] Voxel VoxelAt(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d in_voxels = (p - origin) / voxel_m;
    return {static_cast<int>(std::floor(in_voxels.x())),
            static_cast<int>(std::floor(in_voxels.y())),
            static_cast<int>(std::floor(in_voxels.z()))};
  }
};

/// The volume round all cameras and all samples but the farthest thousandth in each direction, half
/// a metre wider; the voxels lie at whole multiples of their side. Cost O(samples).
[[nodiscard]] VoxelFrame FrameOf(const std::vector<SurfaceSample>& samples, double voxel_m);

}  // namespace enfilade
