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

ImageF BlurColumns(const ImageF& image, const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  const size_t length = static_cast<size_t>(image.cols()) * static_cast<size_t>(image.channels());
  ImageF out(image.rows(), image.cols(), image.channels());
  for (int r = 0; r < image.rows(); ++r) {
    for (int k = -radius; k <= radius; ++k) {
      const int from = std::clamp(r + k, 0, image.rows() - 1);
      AddWeighted(image.row(from), kernel[static_cast<size_t>(k + radius)], length, out.row(r));
    }
  }
  return out;
}

ImageF BlurRows(const ImageF& image, const std::vector<float>& kernel, bool wraps) {
  const int radius = static_cast<int>(kernel.size() / 2), cols = image.cols();
  const auto channels = static_cast<size_t>(image.channels());
  ImageF out(image.rows(), cols, image.channels());
  std::vector<float> row(static_cast<size_t>(cols + 2 * radius) * channels);  // with its borders
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = -radius; c < cols + radius; ++c) {
      const int from = wraps ? (c % cols + cols) % cols : std::clamp(c, 0, cols - 1);
      std::copy_n(image.row(r) + static_cast<size_t>(from) * channels, channels,
                  row.begin() + static_cast<int64_t>(static_cast<size_t>(c + radius) * channels));
    }
    for (size_t k = 0; k < kernel.size(); ++k) {
      AddWeighted(row.data() + k * channels, kernel[k], static_cast<size_t>(cols) * channels,
                  out.row(r));
    }
  }
  return out;
}

}  // namespace

ImageU8 ExposeSensor(ImageF ideal, double blur_px, double noise, bool wraps, uint64_t seed) {
  const std::vector<float> kernel = GaussianKernel(blur_px);
  ideal = BlurRows(ideal, kernel, wraps);
  ideal = BlurColumns(ideal, kernel);
  Random random(seed);
  ImageU8 out(ideal.rows(), ideal.cols(), ideal.channels());
  for (size_t i = 0; i < out.data().size(); ++i) {
    const double value = ideal.data()[i] + (noise > 0 ? noise * random.Normal() : 0.0);
    out.data()[i] = static_cast<uint8_t>(std::clamp(value, 0.0, 255.0) + 0.5);
  }
  return out;
}

}  // namespace enfilade
