// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/image.h"

namespace enfilade {

/// A grey panorama of 2·rows × rows pixels full of round blobs of all sizes from 0.6° to 6°.
inline ImageU8 BlobPanorama(int rows, uint32_t seed) {
  constexpr int kNumBlobs = 1500;
  constexpr double kReach = 3;  // standard deviations
  const int cols = 2 * rows;
  const double rad_per_px = kPi / rows;
  std::vector<double> values(static_cast<size_t>(rows) * static_cast<size_t>(cols), 128);
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < kNumBlobs; ++i) {
    const double x = uniform() * cols, elevation_rad = std::asin(1.8 * uniform() - 0.9);
    const double y = rows / 2.0 - elevation_rad / rad_per_px;
    const double sigma_px = 0.01 * std::pow(10, uniform()) / rad_per_px;
    const double height = uniform() < 0.5 ? -60 : 60;
    const double squeeze = std::cos(elevation_rad);
    const int reach_y = static_cast<int>(kReach * sigma_px);
    const int reach_x = static_cast<int>(kReach * sigma_px / squeeze);
    const int row = static_cast<int>(y), col = static_cast<int>(x);
    for (int r = std::max(0, row - reach_y); r <= std::min(rows - 1, row + reach_y); ++r) {
      for (int c = col - reach_x; c <= col + reach_x; ++c) {
        const double distance = std::hypot((c + 0.5 - x) * squeeze, r + 0.5 - y) / sigma_px;
        values[static_cast<size_t>(r * cols + (c % cols + cols) % cols)] +=
            height * std::exp(-0.5 * distance * distance);
      }
    }
  }
  ImageU8 panorama(rows, cols);
  for (size_t i = 0; i < values.size(); ++i) {
    panorama.data()[i] = static_cast<uint8_t>(std::clamp(values[i], 0.0, 255.0));
  }
  return panorama;
}

}  // namespace enfilade
