// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/sfm/drawn_texture.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {

DrawnTexture::DrawnTexture(int seed, int period_px) {
  constexpr int kNumWaves = 24;
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (int i = 0; i < kNumWaves; ++i) {
    const double length_px = uniform(12, 40), direction = uniform(0, 2 * kPi);
    const double per_period = std::round(std::cos(direction) / length_px * period_px);
    waves_.push_back({{per_period / period_px, std::sin(direction) / length_px},
                      uniform(0, 2 * kPi),
                      uniform(5, 9)});
  }
}

double DrawnTexture::At(const Eigen::Vector2d& position) const {
  double sum = 100;
  for (const Wave& wave : waves_) {
    sum += wave.amplitude * std::sin(2 * kPi * wave.frequency.dot(position) + wave.phase);
  }
  return sum;
}

ImageU8 DrawnTexture::Draw(int rows, int cols, const Eigen::Vector2d& shift, double gain) const {
  ImageU8 image(rows, cols);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const double value = gain * At(Eigen::Vector2d(c + 0.5, r + 0.5) - shift);
      image(r, c) = static_cast<uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return image;
}

}  // namespace enfilade
