// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/voxel_frame.h"

#include <algorithm>
#include <limits>

namespace enfilade {
namespace {

constexpr double kTail = 0.001;
constexpr double kMargin_m = 0.5;
// Voxels between the volume's border and anything seen, at least.
constexpr double kMinMargin = 3;

}  // namespace

VoxelFrame FrameOf(const std::vector<SurfaceSample>& samples, double voxel_m) {
  VoxelFrame frame;
  frame.voxel_m = voxel_m;
  if (samples.empty()) return frame;
  const double margin = std::max(kMargin_m, kMinMargin * voxel_m);
  std::vector<double> values(samples.size());
  const auto tail = static_cast<ptrdiff_t>(kTail * static_cast<double>(samples.size()));
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (size_t i = 0; i < samples.size(); ++i) {
      values[i] = samples[i].position[axis];
      low = std::min(low, samples[i].camera[axis]);
      high = std::max(high, samples[i].camera[axis]);
    }
    std::nth_element(values.begin(), values.begin() + tail, values.end());
    low = std::min(low, values[static_cast<size_t>(tail)]);
    std::nth_element(values.begin(), values.end() - 1 - tail, values.end());
    high = std::max(high, *(values.end() - 1 - tail));
    const double first = std::floor((low - margin) / voxel_m),
                 last = std::ceil((high + margin) / voxel_m);
    frame.origin[axis] = first * voxel_m;
    // The caller refuses what is too large; the number fits in any case.
    frame.size[static_cast<size_t>(axis)] = static_cast<int>(std::min(last - first, 1e6));
  }
  return frame;
}

}  // namespace enfilade
