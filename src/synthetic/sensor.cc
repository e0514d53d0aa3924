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

void AddWeighted(const float* from, float weight, size_t count, float* to) {
  for (size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

// One pass along rows (wrapping) or columns (clamped).
ImageF Blur(const ImageF& image, const std::vector<float>& kernel, bool is_along_row) {
  const int radius = static_cast<int>(kernel.size() / 2), cols = image.cols();
  const size_t length = static_cast<size_t>(cols) * static_cast<size_t>(image.channels());
  ImageF out(image.rows(), cols, image.channels());
  for (int r = 0; r < image.rows(); ++r) {
    for (int k = -radius; k <= radius; ++k) {
      const float weight = kernel[static_cast<size_t>(k + radius)];
      if (!is_along_row) {
        AddWeighted(image.row(std::clamp(r + k, 0, image.rows() - 1)), weight, length, out.row(r));
        continue;
      }
      const size_t shift = static_cast<size_t>((k % cols + cols) % cols * image.channels());
      AddWeighted(image.row(r) + shift, weight, length - shift, out.row(r));
      AddWeighted(image.row(r), weight, shift, out.row(r) + length - shift);
    }
  }
  return out;
}

}  // namespace

ImageU8 ExposeSensor(ImageF ideal, double blur_px, double noise, uint64_t seed) {
  const std::vector<float> kernel = GaussianKernel(blur_px);
  ideal = Blur(ideal, kernel, true);
  ideal = Blur(ideal, kernel, false);
  Random random(seed);
  ImageU8 out(ideal.rows(), ideal.cols(), ideal.channels());
  for (size_t i = 0; i < out.data().size(); ++i) {
    const double value = ideal.data()[i] + (noise > 0 ? noise * random.Normal() : 0.0);
    out.data()[i] = static_cast<uint8_t>(std::clamp(value, 0.0, 255.0) + 0.5);
  }
  return out;
}

}  // namespace enfilade
