// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/sensor.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace enfilade {
namespace {

std::vector<float> GaussianKernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> kernel;
  double sum = 0;
  for (int k = -radius; k <= radius; ++k) {
    kernel.push_back(
        static_cast<float>(sigma > 0 ? std::exp(-0.5 * k * k / (sigma * sigma)) : 1.0));
    sum += kernel.back();
  }
  for (float& weight : kernel) weight = static_cast<float>(weight / sum);
  return kernel;
}

// One pass along rows (wrapping) or columns (clamped).
ImageF Blur(const ImageF& image, const std::vector<float>& kernel, bool is_along_row) {
  const int radius = static_cast<int>(kernel.size() / 2);
  ImageF out(image.rows(), image.cols(), image.channels());
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.cols(); ++c) {
      for (int k = -radius; k <= radius; ++k) {
        const int row = is_along_row ? r : std::clamp(r + k, 0, image.rows() - 1);
        const int col = is_along_row ? (c + k + radius * image.cols()) % image.cols() : c;
        const float weight = kernel[static_cast<size_t>(k + radius)];
        for (int i = 0; i < image.channels(); ++i) out(r, c, i) += weight * image(row, col, i);
      }
    }
  }
  return out;
}

}  // namespace

ImageU8 ExposeSensor(const ImageF& ideal, double blur_px, double noise, uint64_t seed) {
  const std::vector<float> kernel = GaussianKernel(blur_px);
  const ImageF blurred = Blur(Blur(ideal, kernel, true), kernel, false);
  Random random(seed);
  ImageU8 out(ideal.rows(), ideal.cols(), ideal.channels());
  for (size_t i = 0; i < out.data().size(); ++i) {
    const double value = blurred.data()[i] + (noise > 0 ? noise * random.Normal() : 0.0);
    out.data()[i] = static_cast<uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return out;
}

}  // namespace enfilade
